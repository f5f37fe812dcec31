#pragma once

#include <cmath>

#include "image/real_math.h"
#include "image/vec.h"

namespace kagefude {

/// Where a direction of the world points, in turns.
struct ViewAngles {
  float round = 0;  ///< about the up axis, 0..1
  float above = 0;  ///< above the horizon, -0.25..0.25
};

/// Of a direction of any length; `upIsY`: world's up axis, else Z. The zero vector gives 0.
inline ViewAngles viewAngles(const V3d& direction, bool upIsY) {
  const auto x = static_cast<float>(direction.x);
  const auto y = static_cast<float>(upIsY ? -direction.z : direction.y);
  const auto z = static_cast<float>(upIsY ? direction.y : direction.z);
  const float level = std::sqrt(x * x + y * y);
  const float above = turnsOf(z, level);
  return {turnsOf(y, x), above > 0.5f ? above - 1.0f : above};
}

}  // namespace kagefude
