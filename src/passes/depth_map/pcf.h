#pragma once

#include "base/parameter.h"
#include "passes/depth_map/shadow_map.h"

namespace kagefude {

struct PcfParams {
  int samples = 32;          ///< n, taps a pixel
  float radius = 2.0f;       ///< E, texels
  float size = 0.0f;         ///< further radius in world units at the receiver
  float bias = 0.5f;         ///< texel widths at the receiver
  float slope_bias = 1.0f;   ///< how far the test follows the receiver's plane, 0 to 1
  float spread_bias = 0.1f;  ///< further bias per unit of a tap's distance from the pixel
  int seed = 0;
};

inline constexpr Parameter pcfParameters[] = {
    number<&PcfParams::samples>("samples", 1, 256, "", "Taps into the shadow map for each pixel."),
    number<&PcfParams::radius>("radius", 0, 256, "texels", "Radius of the disc of taps."),
    number<&PcfParams::size>("size", 0, 1e6, "world units",
                             "Radius that is added at the receiver, whatever the map's size."),
    number<&PcfParams::bias>("bias", 0, 100, "texels",
                             "Depth by which a surface may lie behind the stored one and be lit, "
                             "in texel widths at the receiver."),
    number<&PcfParams::slope_bias>("slope_bias", 0, 1, "",
                                   "How far the depth test follows the receiver's own plane; 0 "
                                   "tests one depth for all taps."),
    number<&PcfParams::spread_bias>("spread_bias", 0, 10, "",
                                    "Further bias per unit of a tap's distance from the pixel, "
                                    "against self-shadow in hollows."),
    number<&PcfParams::seed>("seed", 0, 1e9, "", "Chooses the turn of the taps at each pixel."),
};
inline constexpr ParameterTable pcfTable{
    "pcf", "Visibility by percentage-closer filtering of a light's depth map.",
    "002 sections 4.1 and 4.2.1", pcfParameters};

/// B = (1/n) Σ I(V, S(A + E·Ji)) (002 section 4.2.1): the share of n taps into the shadow map, in a
/// disc of radius E texels round the pixel's place A, at which the pixel is lit.
///
/// position, normal: world space, world units; normals may be empty (then no slope bias). labels:
/// 0 = background, visibility 1. E = radius + size in texels at the receiver, at most 1024.
/// Ji: n points of a golden-angle spiral, equal areas, turned by a hash of (x, y, seed): the same
/// in every frame. Each tap reads the texel it falls in.
///
/// Test (002 section 4.1, mended: V = S never holds in floating point): lit when V' - bias <= S,
/// with V' the depth of the receiver's tangent plane at that texel's centre, so a flat receiver
/// needs no other slope bias; a hollow one rises above that plane, so the bias grows by
/// `spread_bias` with the tap's distance. A pixel whose normal points away from the light is hidden
/// by its own body: 0, since there the plane would leak. |V' - V| is held below 8 times the
/// distance on the map, where the plane is seen almost edge-on. A tap outside the map, a pixel
/// behind the light, a NaN position and a NaN depth are lit. Throws InputError when sizes differ or
/// the map is empty.
///
/// Cost: n reads a pixel in penumbrae; elsewhere 4 reads of a depth pyramid decide, with the same
/// bits as the taps would give.
Floats pcfVisibility(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                     const ShadowMap& map, const PcfParams& params);

namespace detail {
/// pcfVisibility without the pyramid, for tests: both must give the same bits.
Floats pcfVisibilityByTaps(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                           const ShadowMap& map, const PcfParams& params);
}  // namespace detail

}  // namespace kagefude
