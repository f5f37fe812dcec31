#include "passes/search/pair_search.h"

#include <atomic>
#include <cmath>
#include <unordered_map>

#include "image/parallel.h"
#include "passes/search/classes.h"
#include "passes/search/nearest_site.h"
#include "passes/search/pair_grid.h"

namespace kagefude {
namespace {

constexpr auto umbra = static_cast<uint8_t>(ShadowClass::umbra);
constexpr auto penumbra = static_cast<uint8_t>(ShadowClass::penumbra);
constexpr auto lit = static_cast<uint8_t>(ShadowClass::lit);

/// Squared distances to the nearest umbra and lit pixel, and what stands in for missing ones.
class PairDistances {
 public:
  /// Searches where wantedKinds is wantedKind; labels may be empty (no bound).
  PairDistances(View<const uint8_t> classes, View<const uint32_t> labels,
                View<const uint8_t> wantedKinds, uint8_t wantedKind)
      : labels_(labels),
        toUmbra_(classes.width, classes.height),
        toLit_(classes.width, classes.height) {
    SiteSearch search{classes, umbra, wantedKinds, wantedKind, labels};
    const std::vector<LabelBox> boxes = findLabelBoxes(search);
    findNearestSites(search, boxes, toUmbra_);
    search.siteKind = lit;
    findNearestSites(search, boxes, toLit_);
    findDeepest();
  }

  /// D1 and D2 in pixels (eq. 3.3) at a searched pixel. A missing one is the largest other one of
  /// the label; both are 1 when both are missing.
  struct Pair {
    float umbra, lit;
  };
  Pair at(int x, int y) const {
    const uint32_t u = toUmbra_(x, y), l = toLit_(x, y);
    if (u != noSite && l != noSite) return {root(u), root(l)};
    const auto deepest = deepest_.find(labelAt(x, y));
    const float stand = deepest == deepest_.end() ? 1.0f : root(deepest->second);
    return {u == noSite ? stand : root(u), l == noSite ? stand : root(l)};
  }

 private:
  static float root(uint32_t squared) { return std::sqrt(static_cast<float>(squared)); }
  uint32_t labelAt(int x, int y) const { return labels_.empty() ? 0 : labels_(x, y); }
  bool oneMissing(int x, int y) const {
    return (toUmbra_(x, y) == noSite) != (toLit_(x, y) == noSite);
  }

  /// Largest distance found, for the labels in which one of the two kinds of sites is missing.
  void findDeepest() {
    std::atomic<bool> anyMissing = false;
    parallelRows(toLit_.height(), [&](int y0, int y1) {
      bool missing = false;
      for (int y = y0; y < y1; ++y)
        for (int x = 0; x < toLit_.width(); ++x) missing |= oneMissing(x, y);
      if (missing) anyMissing.store(true, std::memory_order_relaxed);
    });
    if (!anyMissing) return;
    for (int y = 0; y < toLit_.height(); ++y)
      for (int x = 0; x < toLit_.width(); ++x) {
        if (!oneMissing(x, y)) continue;
        uint32_t& deepest = deepest_[labelAt(x, y)];
        deepest = std::max(deepest, std::min(toUmbra_(x, y), toLit_(x, y)));
      }
  }

  View<const uint32_t> labels_;
  Labels toUmbra_, toLit_;
  std::unordered_map<uint32_t, uint32_t> deepest_;
};

/// Eq. 3.4, mended to visibility.
float ratio(PairDistances::Pair d) { return d.umbra / (d.umbra + d.lit); }

Floats settledClasses(View<const uint8_t> classes) {
  Floats visibility(classes.width, classes.height);
  parallelRows(classes.height, [&](int y0, int y1) {
    const ptrdiff_t first = static_cast<ptrdiff_t>(y0) * classes.width;
    const ptrdiff_t end = static_cast<ptrdiff_t>(y1) * classes.width;
    for (ptrdiff_t i = first; i < end; ++i)
      visibility.view().data[i] = classes.data[i] == umbra ? 0.0f : 1.0f;
  });
  return visibility;
}

void searchEverywhere(View<const uint8_t> classes, View<const uint32_t> labels,
                      View<float> visibility) {
  const PairDistances distances(classes, labels, classes, penumbra);
  parallelRows(classes.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < classes.width; ++x)
        if (classes(x, y) == penumbra) visibility(x, y) = ratio(distances.at(x, y));
  });
}

void refineByWidth(View<const uint8_t> classes, View<const uint32_t> labels, PairGrid& grid) {
  const Bytes corners = grid.searched();
  const PairDistances distances(classes, labels, corners, 1);
  grid.refine([&](int x, int y) {
    const PairDistances::Pair d = distances.at(x, y);
    return d.umbra + d.lit;
  });
}

void searchGrid(View<const uint8_t> classes, View<const uint32_t> labels, const PairParams& params,
                View<float> visibility) {
  PairGrid grid(classes, labels, params.step);
  if (params.adaptive) refineByWidth(classes, labels, grid);
  const Bytes searched = grid.searched();
  const PairDistances distances(classes, labels, searched, 1);
  // Corners first, so that the interpolation reads finished values only.
  parallelRows(classes.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < classes.width; ++x)
        if (searched(x, y)) visibility(x, y) = ratio(distances.at(x, y));
  });
  parallelRows(classes.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < classes.width; ++x)
        if (classes(x, y) == penumbra && !searched(x, y))
          visibility(x, y) = grid.interpolate(x, y, visibility);
  });
}

}  // namespace

Floats pairVisibility(View<const uint8_t> farMask, View<const uint8_t> nearMask,
                      View<const uint32_t> labels, const PairParams& params) {
  const View<const uint8_t> masks[] = {farMask, nearMask};
  const Bytes classes = classifyShadow(masks, labels);
  Floats visibility = settledClasses(classes);
  const bool bounded = params.bound != SearchBound::none;
  const View<const uint32_t> bound = bounded ? labels : View<const uint32_t>{};
  if (params.search == PairSearch::exact) {
    searchEverywhere(classes, bound, visibility);
  } else {
    searchGrid(classes, bound, params, visibility);
  }
  return visibility;
}

}  // namespace kagefude
