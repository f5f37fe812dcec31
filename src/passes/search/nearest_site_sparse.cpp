#include "passes/search/nearest_site_sparse.h"

#include <tbb/parallel_for.h>

#include <unordered_map>

#include "passes/search/site_rows.h"

namespace kagefude::detail {
namespace {

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
