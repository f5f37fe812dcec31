#include "passes/ground/behind_things.h"

#include "image/parallel.h"
#include "passes/search/nearest_site.h"

namespace kagefude {

ColourPlanes extendBehindThings(const ColourViews& picture, View<const uint8_t> open) {
  const int width = open.width, height = open.height;
  SiteSearch search;
  search.kinds = search.wantedKinds = open;
  search.siteKind = 1;
  search.wantedKind = 0;
  Labels squared(width, height, noSite), index(width, height, noSite);
  findNearestSites(search, findLabelBoxes(search), squared, index);
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
