#include "passes/strip/strip_tones.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "image/oklab.h"

namespace kagefude {

std::vector<float> tonesOf(const V3f& linearColour, std::span<const TonePoint> ramp) {
  const V3f own = oklabOfLinear(linearColour);
  std::vector<float> stops;
  for (const TonePoint& point : ramp) {
    const V3f tone(point.lift + point.scale * own.x, point.chroma * own.y, point.chroma * own.z);
    const V3f c = srgbOfOklab(leanTowardsWarm(tone, point.lean));
    stops.insert(stops.end(), {point.place, c.x, c.y, c.z});
  }
  return stops;
}

std::vector<float> stopsOfPalette(std::vector<V3f> encoded) {
  constexpr int between = 8;
  constexpr float leastRange = 0.05f;
  std::vector<V3f> labs;
  for (const V3f& colour : encoded) labs.push_back(oklabOfSrgb(colour));
  std::stable_sort(labs.begin(), labs.end(), [](const V3f& a, const V3f& b) { return a.x < b.x; });
  if (labs.empty() || labs.back().x - labs.front().x < leastRange)
    throw InputError(
        fmt::format("the palette's colours ({}) are all equally bright; a strip needs tones from "
                    "dark to bright",
                    labs.size()));
  std::vector<float> stops;
  const int steps = static_cast<int>(labs.size() - 1) * between;
  for (int i = 0; i <= steps; ++i) {
    const auto from = static_cast<size_t>(std::min(i / between, static_cast<int>(labs.size()) - 2));
    const float share = static_cast<float>(i) / between - static_cast<float>(from);
    const V3f c = srgbOfOklab(labs[from] + (labs[from + 1] - labs[from]) * share);
    const float place = static_cast<float>(i) / static_cast<float>(steps);
    stops.insert(stops.end(), {place, c.x, c.y, c.z});
  }
  return stops;
}

}  // namespace kagefude
