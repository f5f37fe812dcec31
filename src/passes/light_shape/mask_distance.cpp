#include "passes/light_shape/mask_distance.h"

#include <tbb/enumerable_thread_specific.h>

#include <unordered_map>

#include "image/parallel.h"
#include "passes/light_shape/mask_distance_box.h"
#include "passes/require_size.h"
#include "passes/search/site_rows.h"

namespace kagefude {
namespace {

using detail::BoxScratch;
using detail::Place;
using detail::SiteRows;

/// Boxes up to this many pixels go one to a thread; larger ones are cut up among all threads, so
/// that their scratch is never held twice.
constexpr uint64_t largestAlone = 1 << 20;

/// Pixels of scattered labels, each label's in raster order.
std::vector<std::vector<Place>> pixelsOf(std::span<const LabelBox> boxes,
                                         View<const uint32_t> labels) {
  std::unordered_map<uint32_t, size_t> slots;
  for (const LabelBox& box : boxes) slots.emplace(box.label, slots.size());
  std::vector<std::vector<Place>> lists(boxes.size());
  for (size_t i = 0; i < boxes.size(); ++i) lists[i].reserve(boxes[i].pixels);
  for (int y = 0; y < labels.height; ++y) {
    const uint32_t* const row = labels.row(y);
    uint32_t last = 0;
    auto slot = slots.end();
    for (int x = 0; x < labels.width; ++x) {
      if (row[x] != last) {
        last = row[x];
        slot = last ? slots.find(last) : slots.end();
      }
      if (slot != slots.end()) lists[slot->second].push_back({x, y});
    }
  }
  return lists;
}

/// One label by lists of its sites, for every mask.
void measureList(const std::vector<Place>& pixels, std::span<const View<const uint8_t>> masks,
                 const PixelSet& wanted, View<int16_t> distances) {
  std::vector<Place> kinds[2];
  for (size_t k = 0; k < masks.size(); ++k) {
    for (std::vector<Place>& kind : kinds) kind.clear();
    for (const Place p : pixels) kinds[masks[k](p.x, p.y) != 0].push_back(p);
    const SiteRows sites[2] = {SiteRows(kinds[0]), SiteRows(kinds[1])};
    for (const bool lit : {false, true})
      for (const Place p : kinds[lit])
        if (wanted.contains(p.x, p.y))
          distances.row(static_cast<int>(k))[wanted.indexOf(p.x, p.y)] =
              detail::signedDistance(sites[!lit].nearest(p).squared, lit);
  }
}

}  // namespace

Distances maskDistances(std::span<const View<const uint8_t>> masks, const PixelSet& wanted,
                        View<const uint32_t> labels) {
  for (const View<const uint8_t>& mask : masks)
    requireSize("a shadow mask", mask, wanted.width(), wanted.height());
  Distances distances(static_cast<int>(wanted.size()), static_cast<int>(masks.size()));
  if (wanted.size() == 0) return distances;
  std::vector<LabelBox> large, small, thin;
  for (const LabelBox& box : findLabelBoxes(labels, wanted)) {
    const uint64_t area = static_cast<uint64_t>(box.x1 - box.x0) * (box.y1 - box.y0);
    const bool listed = !labels.empty() && isScattered(box);
    (listed ? thin : (area > largestAlone ? large : small)).push_back(box);
  }
  const auto task = [&](const LabelBox& box, size_t k) {
    return detail::MaskBox{masks[k], labels, wanted, box, distances.row(static_cast<int>(k))};
  };
  BoxScratch shared;
  for (const LabelBox& box : large)
    for (size_t k = 0; k < masks.size(); ++k) detail::measureBox(task(box, k), shared, true);
  tbb::enumerable_thread_specific<BoxScratch> own;
  tbb::parallel_for(size_t{0}, small.size() * masks.size(), [&](size_t i) {
    const size_t k = i % masks.size();
    detail::measureBox(task(small[i / masks.size()], k), own.local(), false);
  });
  const std::vector<std::vector<Place>> lists =
      thin.empty() ? std::vector<std::vector<Place>>{} : pixelsOf(thin, labels);
  tbb::parallel_for(size_t{0}, lists.size(),
                    [&](size_t i) { measureList(lists[i], masks, wanted, distances); });
  return distances;
}

}  // namespace kagefude
