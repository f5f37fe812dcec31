#pragma once

#include <cstdint>

#include "passes/tone/light.h"

namespace kagefude {

/// How bright a light is.
struct LightPower {
  float watts = 1;     ///< times luminance; of a sun, and where it does not fall, watts per m^2
  bool falls = false;  ///< whether its light thins out with distance
};

/// Cosine between an area light's direction and the way from it to p: 0 behind it; 1 for other
/// lights, which shine to all sides. A point at the light itself gets 1.
float emissionCosine(const Light& light, const V3f& p);

/// Irradiance at p of a surface that faces the light, were p on the light's axis: a sun gives its
/// power, point and spot P/(4 pi d^2), area lights P/(4 d^2) (measured in Cycles, within 1 %). The
/// distance counts as at least the light's radius, and at least 1e-6.
float irradianceOnAxis(const Light& light, const LightPower& power, const V3f& p);

/// What a light gives to each pixel beside the cosine of the surface. `irradiance` off: the share
/// of an area light's emission, at most `most`, which is what its subject gets; on: the irradiance
/// of a surface that faces the light. Background (label 0) gives 0. Sizes must agree.
Floats lightReach(Vec3View position, View<const uint32_t> labels, const Light& light,
                  const LightPower& power, bool irradiance, float most);

}  // namespace kagefude
