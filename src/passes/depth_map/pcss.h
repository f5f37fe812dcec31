#pragma once

#include "base/parameter.h"
#include "passes/depth_map/shadow_map.h"

namespace kagefude {

struct PcssParams {
  int search = 32;          ///< taps of the blocker search
  int samples = 64;         ///< taps of the filter
  float lightSize = 1.0f;   ///< share of the light's radius
  float bias = 0.5f;        ///< texel widths at the receiver
  float slopeBias = 1.0f;   ///< how far the test follows the receiver's plane, 0 to 1
  float spreadBias = 0.1f;  ///< further bias per unit of a tap's distance from the pixel
  int seed = 0;
};

inline constexpr Parameter pcssParameters[] = {
    number<&PcssParams::search>("search", 1, 256, "", "Taps that look for blockers."),
    number<&PcssParams::samples>("samples", 1, 256, "", "Taps that make the penumbra."),
    number<&PcssParams::lightSize>("light_size", 0, 4, "of the light", "Radius of the light."),
    number<&PcssParams::bias>("bias", 0, 100, "texels",
                              "Depth by which a surface may lie behind the stored one and be lit, "
                              "in texel widths at the receiver."),
    number<&PcssParams::slopeBias>("slope_bias", 0, 1, "",
                                   "How far the depth test follows the receiver's own plane."),
    number<&PcssParams::spreadBias>("spread_bias", 0, 10, "",
                                    "Further bias per unit of a tap's distance from the pixel."),
    number<&PcssParams::seed>("seed", 0, 1e9, "", "Chooses the turn of the taps at each pixel."),
};
inline constexpr ParameterTable pcssTable{
    "pcss", "Visibility from a light's depth map, softer the farther the blocker.",
    "Fernando 2005; method.md section 5", pcssParameters};

/// PCF (see pcf.h, whose conventions and test hold here) with a radius from the blockers: their
/// mean depth B over a first disc of taps gives E = r (V - B)/B at the receiver (for a sun r (V -
/// B)), with r the light's radius, V the receiver's depth.
///
/// lightRadius: world units; for an orthographic map (sun) the tangent of half its angle. The first
/// disc is what the light's disc covers at the nearest stored depth, at most 512 texels.
/// Degenerate: no blocker found, outside the map, behind the light, NaN: lit. A radius of 0 gives
/// one texel's hard test. Throws InputError when sizes differ or the map is empty.
/// Cost: search + samples reads a pixel in reach of a blocker, 4 reads of a pyramid elsewhere.
Floats pcssVisibility(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                      const ShadowMap& map, float lightRadius, const PcssParams& params);

}  // namespace kagefude
