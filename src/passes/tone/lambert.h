#pragma once

#include <cstdint>

#include "base/parameter.h"
#include "passes/tone/light.h"

namespace kagefude {

struct LambertParams {
  float wrap = 0;        ///< how far the shade reaches round behind the terminator
  bool spotCone = true;  ///< fade outside a spot's cone
};

inline constexpr Parameter shadeParameters[] = {
    number<&LambertParams::wrap>("wrap", 0, 1, "",
                                 "How far the shade reaches behind the terminator; 0 is Lambert's "
                                 "law, 1 ends at the far pole."),
    plain<&LambertParams::spotCone>("spot_cone", "Fade the shade outside a spot light's cone."),
};
inline constexpr ParameterTable shadeTable{"shade", "Diffuse shade of the surface facing a light.",
                                           "002 eq. 3.1", shadeParameters};

/// Unit direction from the surface point p towards the light; a sun's is the same everywhere.
/// A point at the light itself gets the zero vector.
V3f towardsLight(const Light& light, const V3f& p);

/// Share of a spot's light that its cone lets through towards p: 1 inside the blend zone, 0 outside
/// the cone, a smooth step of the cosine in between (as Blender draws it); 1 for other lights.
float spotFalloff(const Light& light, const V3f& p);

/// Diffuse shade I = N·L clamped to [0, 1] (002 eq. 3.1), L towards the light. **[ours]** `wrap` w
/// turns it into (N·L + w) / (1 + w). Normals need not be unit: they are normalised, so
/// anti-aliased ones are not darker. Background (label 0), non-finite input and zero normals give
/// 0. Equal sizes are the caller's duty. Cost: two square roots and divisions a pixel.
Floats lambertShade(Vec3View normal, Vec3View position, View<const uint32_t> labels,
                    const Light& light, const LambertParams& params);

}  // namespace kagefude
