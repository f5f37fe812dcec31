#include "passes/nearest_site_sparse.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <unordered_map>

namespace kagefude::detail {
namespace {

struct Place {
  int x, y;
};

/// Pixels of many labels in one array, each label's in raster order.
struct Lists {
  std::vector<Place> places;
  std::vector<size_t> first;  ///< where a label's part starts; one more than labels

  std::span<const Place> of(size_t slot) const {
    return {places.data() + first[slot], places.data() + first[slot + 1]};
  }
};

/// Calls visit(slot, x, y) for every pixel of `kind` whose label has a slot, in raster order.
template <class Visit>
void visitKind(View<const uint8_t> kinds, uint8_t kind, View<const uint32_t> labels,
               const std::unordered_map<uint32_t, size_t>& slots, const Visit& visit) {
  for (int y = 0; y < kinds.height; ++y) {
    uint32_t last = 0;
    auto slot = slots.end();
    for (int x = 0; x < kinds.width; ++x) {
      if (kinds(x, y) != kind) continue;
      if (labels(x, y) != last) {
        last = labels(x, y);
        slot = slots.find(last);
      }
      if (last != 0 && slot != slots.end()) visit(slot->second, x, y);
    }
  }
}

Lists collect(View<const uint8_t> kinds, uint8_t kind, View<const uint32_t> labels,
              const std::unordered_map<uint32_t, size_t>& slots) {
  Lists lists;
  lists.first.assign(slots.size() + 1, 0);
  visitKind(kinds, kind, labels, slots, [&](size_t slot, int, int) { ++lists.first[slot + 1]; });
  for (size_t slot = 0; slot < slots.size(); ++slot) lists.first[slot + 1] += lists.first[slot];
  lists.places.resize(lists.first.back());
  std::vector<size_t> next(lists.first.begin(), lists.first.end() - 1);
  visitKind(kinds, kind, labels, slots, [&](size_t slot, int x, int y) {
    lists.places[next[slot]++] = {x, y};
  });
  return lists;
}

/// The sites of one label, by rows.
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

}  // namespace

void searchLists(const SiteSearch& search, std::span<const LabelBox> boxes, View<uint32_t> squared,
                 View<uint32_t> index) {
  std::unordered_map<uint32_t, size_t> slots;
  slots.reserve(boxes.size());
  for (const LabelBox& box : boxes) slots.emplace(box.label, slots.size());
  const Lists sites = collect(search.kinds, search.siteKind, search.labels, slots);
  const Lists wanted = collect(search.wantedKinds, search.wantedKind, search.labels, slots);
  tbb::parallel_for(size_t{0}, boxes.size(), [&](size_t slot) {
    if (sites.of(slot).empty()) return;
    const SiteRows rows(sites.of(slot));
    for (const Place p : wanted.of(slot)) {
      const SiteRows::Nearest found = rows.nearest(p);
      squared(p.x, p.y) = found.squared;
      if (!index.empty())
        index(p.x, p.y) =
            static_cast<uint32_t>(found.site.y) * static_cast<uint32_t>(squared.width) +
            static_cast<uint32_t>(found.site.x);
    }
  });
}

}  // namespace kagefude::detail
