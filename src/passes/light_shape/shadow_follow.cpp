#include "passes/light_shape/shadow_follow.h"

#include <algorithm>

namespace kagefude {
namespace {

constexpr int placesToAverage = 72;
constexpr float trusted = 0.02f;     ///< mean disagreement up to which a match is trusted fully
constexpr float distrusted = 0.11f;  ///< and from which on not at all
// Shifts in pixels from which on answers are interpolated between every second, and every fourth,
// pixel: they are means over discs of that radius.
constexpr float shortest = 4.0f, wide = 16.0f;

}  // namespace

ShadowFollow::ShadowFollow(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
                           const Distances& distances, const PixelSet& edges,
                           View<const uint32_t> labels, Vec3View position, Vec3View normal,
                           const LightGeometry& geometry, float radius)
    : taps_(masks, places, labels, normal),
      need_(taps_, distances, edges, places),
      match_(taps_, need_, edges, places, position, normal, geometry),
      places_(placesBetween(places, placesToAverage, radius)),
      position_(position),
      normal_(normal),
      geometry_(geometry) {}

ShadowFollow::Answer ShadowFollow::measured(int x, int y) const {
  const ShadowMatch::Match match = match_.at(x, y);
  if (!match.found) return {};
  float trust = std::clamp((distrusted - match.cost) / (distrusted - trusted), 0.0f, 1.0f);
  if (trust > 0) trust *= need_.at(x, y);
  if (trust <= 0) return {};
  const ShadowShift along = shadowShiftAt(x, y, taps_.labels(), position_, normal_, geometry_);
  if (!along.valid) return {};
  const ShadowTaps::Mean mean = taps_.mean(places_, x, y, along, match.shift);
  return mean.valid ? Answer{mean.visibility, trust * along.trust, match.shift} : Answer{};
}

ShadowFollow::Band::Band(const ShadowFollow& follow, int y0, int y1)
    : follow_(follow), firstRow_(y0 / 2) {
  if (follow.match_.tile() == ShadowMatch::smallestTile) return;
  const View<const uint32_t> labels = follow.taps_.labels();
  const int rows = std::min(y1 / 2 + 1, (labels.height + 1) / 2) - firstRow_;
  sparse_ = Plane<Answer>((labels.width + 1) / 2, rows);
  for (int y = 0; y < rows; y += 2)
    for (int x = 0; x < sparse_.width(); x += 2)
      sparse_(x, y) = follow.measured(2 * x, 2 * (firstRow_ + y));
  for (int y = 0; y < rows; ++y)
    for (int x = 1 - (y & 1); x < sparse_.width(); x += 2 - (y & 1))
      sparse_(x, y) = betweenWide(x, y);
}

ShadowFollow::Answer ShadowFollow::Band::betweenWide(int i, int j) const {
  const int x = 2 * i, y = 2 * (firstRow_ + j);
  if (!mayAnswer(x, y)) return {};
  const View<const uint32_t> labels = follow_.taps_.labels();
  Answer sum{0, 0, wide};
  float count = 0;
  for (int v = j & ~1; v <= j + (j & 1); v += 2)
    for (int u = i & ~1; u <= i + (i & 1); u += 2) {
      if (u >= sparse_.width() || v >= sparse_.height()) return follow_.measured(x, y);
      const Answer& a = sparse_(u, v);
      const bool same = labels(2 * u, 2 * (firstRow_ + v)) == labels(x, y);
      if (!same || !(a.trust > 0) || a.shift < wide) return follow_.measured(x, y);
      sum.visibility += a.trust * a.visibility;
      sum.trust += a.trust;
      count += 1;
    }
  return {sum.visibility / sum.trust, sum.trust / count, sum.shift};
}

ShadowFollow::Answer ShadowFollow::Band::between(int x, int y) const {
  const int row = y / 2 - firstRow_;
  if ((x & 1) == 0 && (y & 1) == 0) return sparse_(x / 2, row);
  const View<const uint32_t> labels = follow_.taps_.labels();
  const uint32_t label = labels(x, y);
  float visibility = 0, trust = 0, count = 0;
  for (int j = row; j <= row + (y & 1); ++j)
    for (int i = x / 2; i <= (x + 1) / 2; ++i) {
      if (i >= sparse_.width() || j >= sparse_.height()) continue;
      if (labels(2 * i, 2 * (firstRow_ + j)) != label) continue;
      const Answer& a = sparse_(i, j);
      if (a.trust > 0 && a.shift < shortest) return follow_.measured(x, y);
      visibility += a.trust * a.visibility;
      trust += a.trust;
      count += 1;
    }
  if (count == 0) return follow_.measured(x, y);
  return trust > 0 ? Answer{visibility / trust, trust / count, shortest} : Answer{};
}

}  // namespace kagefude
