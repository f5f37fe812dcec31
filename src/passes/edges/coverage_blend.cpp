#include "passes/edges/coverage_blend.h"

#include <algorithm>

#include "passes/edges/mix_at_edges.h"

namespace kagefude {
namespace {

// Mean colour of the pixels of `id` within `radius`; false when there is none.
bool lentColour(const ColourViews& colour, View<const uint32_t> ownId, int x, int y, uint32_t id,
                int radius, Rgba& result) {
  Rgba sum{};
  int count = 0;
  const int left = std::max(x - radius, 0), right = std::min(x + radius, ownId.width - 1);
  const int top = std::max(y - radius, 0), bottom = std::min(y + radius, ownId.height - 1);
  for (int qy = top; qy <= bottom; ++qy) {
    const uint32_t* const ids = ownId.row(qy);
    for (int qx = left; qx <= right; ++qx)
      if (ids[qx] == id) {
        sum += paintAt(colour, qx, qy);
        ++count;
      }
  }
  if (count == 0) return false;
  result = sum / static_cast<float>(count);
  return true;
}

Rgba blended(const ColourViews& colour, View<const uint32_t> ownId,
             std::span<const CoverageRank> ranks, int x, int y) {
  Rgba sum{};
  float found = 0, named = 0;
  for (const CoverageRank& rank : ranks) {
    const float share = rank.coverage(x, y);
    const uint32_t id = rank.id(x, y);
    if (id == 0 || !(share >= smallestShare)) continue;
    named += share;
    Rgba lent = paintAt(colour, x, y);
    if (id != ownId(x, y) && !lentColour(colour, ownId, x, y, id, 1, lent) &&
        !lentColour(colour, ownId, x, y, id, 2, lent))
      continue;
    sum += lent * share;
    found += share;
  }
  if (!(named > 0.0f)) return Rgba{};
  // Nothing of what covers the pixel has a colour nearby: keep the pixel's own.
  if (!(found > 0.0f)) return paintAt(colour, x, y);
  return sum * ((named < 1.0f ? named : 1.0f) / found);
}

}  // namespace

void blendByCoverage(const PaintViews& paint, View<const uint32_t> ownId,
                     std::span<const CoverageRank> ranks) {
  const ColourViews colour{paint.r, paint.g, paint.b, paint.a};
  mixAtEdges(
      paint,
      [&](int x, int y) {
        return ranks.empty() ||
               (ranks[0].coverage(x, y) >= fullShare && ranks[0].id(x, y) == ownId(x, y));
      },
      [&](int x, int y) { return blended(colour, ownId, ranks, x, y); });
}

}  // namespace kagefude
