#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "passes/search/nearest_site.h"

namespace kagefude::detail {

struct Place {
  int x, y;
};

/// Sites in raster order, and the nearest of them to a place: the rows that hold sites, outward
/// from the place's own, each by bisection.
class SiteRows {
 public:
  explicit SiteRows(std::span<const Place> sites) : sites_(sites) {
    for (size_t i = 0; i < sites.size(); ++i)
      if (i == 0 || sites[i].y != sites[i - 1].y) rows_.push_back(i);
    rows_.push_back(sites.size());
  }

  struct Nearest {
    uint32_t squared = noSite;
    Place site{};
  };
  Nearest nearest(Place p) const {
    Nearest best;
    const size_t count = rows_.size() - 1;
    size_t below = static_cast<size_t>(
        std::partition_point(rows_.begin(), rows_.begin() + static_cast<ptrdiff_t>(count),
                             [&](size_t i) { return sites_[i].y < p.y; }) -
        rows_.begin());
    size_t above = below;  // rows [0, above) are still to be seen upward
    bool goUp = above > 0, goDown = below < count;
    while (goUp || goDown) {
      if (goUp) goUp = lowerByRow(--above, p, best) && above > 0;
      if (goDown) goDown = lowerByRow(below++, p, best) && below < count;
    }
    return best;
  }

 private:
  /// False when the row is so far that neither it nor those beyond can matter.
  bool lowerByRow(size_t row, Place p, Nearest& best) const {
    const int64_t down = sites_[rows_[row]].y - p.y;
    if (down * down > best.squared) return false;
    const Place* const first = sites_.data() + rows_[row];
    const Place* const end = sites_.data() + rows_[row + 1];
    const Place* const right =
        std::lower_bound(first, end, p.x, [](const Place& s, int x) { return s.x < x; });
    if (right != first) lowerBySite(right[-1], p, best);
    if (right != end) lowerBySite(*right, p, best);
    return true;
  }

  static void lowerBySite(Place s, Place p, Nearest& best) {
    const int64_t dx = s.x - p.x, dy = s.y - p.y;
    const auto d2 = static_cast<uint32_t>(dx * dx + dy * dy);
    if (d2 > best.squared) return;
    const bool first = s.y < best.site.y || (s.y == best.site.y && s.x < best.site.x);
    if (d2 < best.squared || first) best = {d2, s};
  }

  std::span<const Place> sites_;
  std::vector<size_t> rows_;
};

}  // namespace kagefude::detail
