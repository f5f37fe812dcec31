#include "passes/edges/coverage_blend.h"

#include "image/parallel.h"
#include "passes/strip/strip.h"

namespace kagefude {
namespace {

constexpr float fullShare = 1.0f - smallestShare;

Rgba colourAt(const ColourViews& c, int x, int y) {
  return Rgba{c.r(x, y), c.g(x, y), c.b(x, y), c.a(x, y)};
}

// Mean colour of the pixels of `id` within `radius`; false when there is none.
bool lentColour(const ColourViews& colour, View<const uint32_t> ownId, int x, int y, uint32_t id,
                int radius, Rgba& result) {
  Rgba sum{};
  int count = 0;
  for (int qy = y - radius; qy <= y + radius; ++qy)
    for (int qx = x - radius; qx <= x + radius; ++qx)
      if (ownId.contains(qx, qy) && ownId(qx, qy) == id) {
        sum += colourAt(colour, qx, qy);
        ++count;
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
    Rgba lent = colourAt(colour, x, y);
    if (id != ownId(x, y) && !lentColour(colour, ownId, x, y, id, 1, lent) &&
        !lentColour(colour, ownId, x, y, id, 2, lent))
      continue;
    sum += lent * share;
    found += share;
  }
  if (!(named > 0.0f)) return Rgba{};
  // Nothing of what covers the pixel has a colour nearby: keep the pixel's own.
  if (!(found > 0.0f)) return colourAt(colour, x, y);
  return sum * ((named < 1.0f ? named : 1.0f) / found);
}

}  // namespace

ColourPlanes blendByCoverage(const ColourViews& colour, View<const uint32_t> ownId,
                             std::span<const CoverageRank> ranks) {
  const int width = ownId.width, height = ownId.height;
  ColourPlanes result{Floats(width, height), Floats(width, height), Floats(width, height),
                      Floats(width, height)};
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const bool plain = ranks.empty() || (ranks[0].coverage(x, y) >= fullShare &&
                                             ranks[0].id(x, y) == ownId(x, y));
        const Rgba c = plain ? colourAt(colour, x, y) : blended(colour, ownId, ranks, x, y);
        result.r(x, y) = c[0];
        result.g(x, y) = c[1];
        result.b(x, y) = c[2];
        result.a(x, y) = c[3];
      }
  });
  return result;
}

}  // namespace kagefude
