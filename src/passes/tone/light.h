#pragma once

#include <string_view>

#include "image/real_math.h"
#include "image/vec.h"

namespace kagefude {

enum class LightType { point, spot, sun, area };
/// As the look and the sidecar spell them, in the order of the values.
inline constexpr std::string_view lightTypeNames[] = {"point", "spot", "sun", "area"};

/// A light as the shading and brush passes see it. World space, world units.
struct Light {
  using Type = LightType;
  Type type = Type::point;
  V3f position{0, 0, 0};    ///< centre of the light; a sun does not use it
  V3f direction{0, 0, -1};  ///< unit, the way the light travels; a point light does not use it
  float radius = 0;         ///< point, spot, area: of its disc; sun: tangent of half its angle
  float spotAngle = pi;     ///< full opening of a spot's cone, radians
  float spotBlend = 0;      ///< share of the cone over which a spot fades, 0..1
};

}  // namespace kagefude
