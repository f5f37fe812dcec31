#include "passes/ground/behind_things.h"

#include <algorithm>

#include "image/parallel.h"
#include "passes/search/nearest_site.h"

namespace kagefude {

uint32_t openNearby(View<const uint8_t> kinds, uint8_t open, int x, int y) {
  constexpr int radius = 3;
  const int left = std::max(x - radius, 0), right = std::min(x + radius, kinds.width - 1);
  const int top = std::max(y - radius, 0), bottom = std::min(y + radius, kinds.height - 1);
  int best = radius * radius + 1;
  uint32_t found = noSite;
  for (int v = top; v <= bottom; ++v) {
    const uint8_t* const row = kinds.row(v);
    for (int u = left; u <= right; ++u) {
      const int squared = (u - x) * (u - x) + (v - y) * (v - y);
      if (row[u] != open || squared >= best) continue;
      best = squared;
      found =
          static_cast<uint32_t>(v) * static_cast<uint32_t>(kinds.width) + static_cast<uint32_t>(u);
    }
  }
  return found;
}

Labels nearestOpen(View<const uint8_t> kinds, uint8_t open, uint8_t wanted) {
  SiteSearch search;
  search.kinds = search.wantedKinds = kinds;
  search.siteKind = open;
  search.wantedKind = wanted;
  // Without labels the search writes every pixel.
  Labels squared(kinds.width, kinds.height), index(kinds.width, kinds.height);
  findNearestSites(search, findLabelBoxes(search), squared, index);
  return index;
}

ColourPlanes extendBehindThings(const ColourViews& picture, View<const uint8_t> open) {
  const int width = open.width, height = open.height;
  const Labels index = nearestOpen(open, 1, 0);
  ColourPlanes result{Floats(width, height), Floats(width, height), Floats(width, height),
                      Floats(width, height)};
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const size_t own =
            static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
        const bool isOpen = open(x, y) == 1;
        const size_t from = isOpen ? own : index(x, y);
        const bool known = isOpen || index(x, y) != noSite;
        result.r(x, y) = known ? picture.r.data[from] : 0.0f;
        result.g(x, y) = known ? picture.g.data[from] : 0.0f;
        result.b(x, y) = known ? picture.b.data[from] : 0.0f;
        result.a(x, y) = !known ? 0.0f : picture.a.empty() ? 1.0f : picture.a.data[from];
      }
  });
  return result;
}

}  // namespace kagefude
