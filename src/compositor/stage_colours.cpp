#include "compositor/stage_colours.h"

#include <algorithm>
#include <cmath>

namespace kagefude {

V3f labelColour(uint32_t label) {
  if (label == 0) return {0, 0, 0};
  const uint32_t hash = (label ^ (label >> 15)) * 0x9e3779b1u;
  const float hue = static_cast<float>(hash >> 8) / 16777216.0f * 6.0f;
  const float value = 0.6f + 0.4f * static_cast<float>(hash & 255u) / 255.0f;
  const auto ramp = [&](float shift) {
    const float h = std::fmod(hue + shift, 6.0f);
    return value * (0.25f + 0.75f * std::clamp(std::fabs(h - 3.0f) - 1.0f, 0.0f, 1.0f));
  };
  return {ramp(0), ramp(4), ramp(2)};
}

V3f classColour(ShadowClass shadow) {
  switch (shadow) {
    case ShadowClass::umbra:
      return {0.02f, 0.02f, 0.10f};
    case ShadowClass::penumbra:
      return {0.93f, 0.62f, 0.15f};
    case ShadowClass::lit:
      return {1, 1, 1};
    case ShadowClass::background:
      break;
  }
  return {0.3f, 0.3f, 0.3f};
}

}  // namespace kagefude
