#include "image/oklab.h"

#include <algorithm>

namespace kagefude {
namespace {

// Directions of orange-yellow sunlight and of the sky's blue in the a, b plane, turns.
constexpr float warmHue = 80.0f / 360.0f, coolHue = 270.0f / 360.0f;
constexpr float tintPerDegree = 0.0007f;

bool canBeShown(const V3f& linear) {
  constexpr float slack = 1e-4f;
  for (int i = 0; i < 3; ++i)
    if (!(linear[i] >= -slack && linear[i] <= 1.0f + slack)) return false;
  return true;
}

}  // namespace

V3f srgbOfOklab(const V3f& lab) {
  const float lightness = std::clamp(lab.x, 0.0f, 1.0f);
  const auto withShare = [&](float share) {
    return linearOfOklab({lightness, lab.y * share, lab.z * share});
  };
  float share = 1.0f;
  if (!canBeShown(withShare(1.0f))) {
    float step = 0.5f;
    share = 0.0f;
    for (int i = 0; i < 12; ++i, step *= 0.5f)
      if (canBeShown(withShare(share + step))) share += step;
  }
  V3f c = withShare(share);
  for (int i = 0; i < 3; ++i) c[i] = std::clamp(srgbOfLinear(c[i]), 0.0f, 1.0f);
  return c;
}

V3f oklabOfSrgb(const V3f& encoded) {
  return oklabOfLinear({linearOfSrgb(encoded.x), linearOfSrgb(encoded.y), linearOfSrgb(encoded.z)});
}

V3f leanTowardsWarm(const V3f& lab, float degrees) {
  if (degrees == 0.0f) return lab;
  const float pole = degrees > 0.0f ? warmHue : coolHue;
  const float most = std::fabs(degrees) / 360.0f;
  const float chroma = std::sqrt(lab.y * lab.y + lab.z * lab.z);
  const float hue = turnsOf(lab.z, lab.y);
  const float way = pole - hue - std::floor(pole - hue + 0.5f);
  const SinCos turned = sinCosTurns(hue + std::clamp(way, -most, most));
  const SinCos tint = sinCosTurns(pole);
  const float strength = tintPerDegree * std::fabs(degrees);
  return {lab.x, chroma * turned.cos + strength * tint.cos,
          chroma * turned.sin + strength * tint.sin};
}

}  // namespace kagefude
