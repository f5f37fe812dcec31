#include "passes/mask_distance.h"

#include <cmath>

#include "image/parallel.h"
#include "passes/nearest_site.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr float farthest = 2000.0f;
constexpr uint8_t notWanted = 2;

void splitKinds(View<const uint8_t> mask, View<const uint8_t> wanted, View<uint8_t> sites,
                View<uint8_t> kinds) {
  parallelRows(mask.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y) {
      const uint8_t *const m = mask.row(y), *const w = wanted.row(y);
      uint8_t *const s = sites.row(y), *const k = kinds.row(y);
      for (int x = 0; x < mask.width; ++x) {
        s[x] = m[x] != 0;
        k[x] = w[x] == 1 ? s[x] : notWanted;
      }
    }
  });
}

void storeSigned(View<const uint32_t> squared, View<const uint8_t> kinds, uint8_t kind,
                 View<int16_t> result) {
  const float sign = kind ? 1.0f : -1.0f;
  parallelRows(result.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < result.width; ++x) {
        if (kinds(x, y) != kind) continue;
        const float d = std::sqrt(static_cast<float>(squared(x, y))) - 0.5f;
        result(x, y) = squared(x, y) == noSite || d > farthest
                           ? (kind ? farLit : farDark)
                           : static_cast<int16_t>(sign * (d / distanceUnit + 0.5f));
      }
  });
}

}  // namespace

std::vector<Distances> maskDistances(std::span<const View<const uint8_t>> masks,
                                     View<const uint8_t> wanted, View<const uint32_t> labels) {
  const int width = wanted.width, height = wanted.height;
  std::vector<Distances> result;
  SiteSearch search{wanted, 0, wanted, 1, labels};
  const std::vector<LabelBox> boxes = findLabelBoxes(search);
  Bytes sites(width, height), kinds(width, height);
  Labels squared(width, height);
  search.kinds = sites;
  search.wantedKinds = kinds;
  for (const View<const uint8_t>& mask : masks) {
    requireSize("a shadow mask", mask, width, height);
    splitKinds(mask, wanted, sites, kinds);
    Distances& signedDistance = result.emplace_back(width, height, int16_t{0});
    for (const uint8_t kind : {uint8_t{0}, uint8_t{1}}) {
      search.wantedKind = kind;
      search.siteKind = 1 - kind;
      findNearestSites(search, boxes, squared);
      storeSigned(squared, kinds, kind, signedDistance);
    }
  }
  return result;
}

}  // namespace kagefude
