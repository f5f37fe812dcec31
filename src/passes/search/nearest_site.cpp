#include "passes/search/nearest_site.h"

#include <algorithm>
#include <unordered_map>

#include "image/parallel.h"
#include "passes/require_size.h"
#include "passes/search/nearest_site_dense.h"
#include "passes/search/nearest_site_sparse.h"

namespace kagefude {
namespace {

constexpr int bandRows = 64;
constexpr int longestSide = 32767;
// A label goes by site lists when its box is more than this many times its pixels, or when it is
// so small that setting up a box costs more than the search.
constexpr uint64_t thinBox = 32;
constexpr uint32_t tinyLabel = 64;
constexpr uint64_t smallBox = 1 << 16;

void requireSide(int width, int height) {
  if (width > longestSide || height > longestSide)
    throw InputError(
        fmt::format("a frame of {}x{} pixels is too large to search; at most {} a side", width,
                    height, longestSide));
}

void requireSearchable(const SiteSearch& s) {
  const int width = s.kinds.width, height = s.kinds.height;
  requireSide(width, height);
  requireSize("the plane of wanted pixels", s.wantedKinds, width, height);
  if (!s.labels.empty()) requireSize("the label plane", s.labels, width, height);
}

void include(LabelBox& box, int x0, int x1, int y0, int y1) {
  box.x0 = std::min(box.x0, x0);
  box.x1 = std::max(box.x1, x1);
  box.y0 = std::min(box.y0, y0);
  box.y1 = std::max(box.y1, y1);
}

void includeWanted(LabelBox& box, int x0, int x1, int y0, int y1) {
  box.wantedX0 = std::min(box.wantedX0, x0);
  box.wantedX1 = std::max(box.wantedX1, x1);
  box.wantedY0 = std::min(box.wantedY0, y0);
  box.wantedY1 = std::max(box.wantedY1, y1);
}

LabelBox emptyBox(uint32_t label) {
  return {label, 0, longestSide, longestSide, 0, 0, longestSide, longestSide, 0, 0};
}

using Boxes = std::unordered_map<uint32_t, LabelBox>;

LabelBox& labelBox(Boxes& boxes, uint32_t label) {
  return boxes.try_emplace(label, emptyBox(label)).first->second;
}

/// A row's runs of labels. ends(x, end) gives the first wanted pixel of [x, end) and the one behind
/// the last, or equal ones.
template <class Ends>
void addRow(View<const uint32_t> labels, int y, const Ends& ends, Boxes& boxes) {
  const uint32_t* const label = labels.row(y);
  for (int x = 0, end; x < labels.width; x = end) {
    for (end = x + 1; end < labels.width && label[end] == label[x];) ++end;
    if (label[x] == 0) continue;
    LabelBox& box = labelBox(boxes, label[x]);
    box.pixels += static_cast<uint32_t>(end - x);
    include(box, x, end, y, y + 1);
    const auto [first, last] = ends(x, end);
    if (first < last) includeWanted(box, first, last, y, y + 1);
  }
}

std::vector<LabelBox> wholeFrame(int width, int height) {
  return {{0, static_cast<uint32_t>(width) * static_cast<uint32_t>(height), 0, 0, width, height, 0,
           0, width, height}};
}

/// ends(y) gives a row's `ends` for addRow.
template <class RowEnds>
std::vector<LabelBox> boxesOf(View<const uint32_t> labels, const RowEnds& ends) {
  const int height = labels.height;
  std::vector<Boxes> bands(static_cast<size_t>((height + bandRows - 1) / bandRows));
  parallelRows(height, bandRows, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      addRow(labels, y, ends(y), bands[static_cast<size_t>(y0 / bandRows)]);
  });
  Boxes all;
  for (const Boxes& band : bands)
    for (const auto& [label, part] : band) {
      LabelBox& box = labelBox(all, label);
      box.pixels += part.pixels;
      include(box, part.x0, part.x1, part.y0, part.y1);
      includeWanted(box, part.wantedX0, part.wantedX1, part.wantedY0, part.wantedY1);
    }
  std::vector<LabelBox> boxes;
  for (const auto& [label, box] : all)
    if (box.wantedX1 > box.wantedX0) boxes.push_back(box);
  std::sort(boxes.begin(), boxes.end(),
            [](const LabelBox& a, const LabelBox& b) { return a.label < b.label; });
  return boxes;
}

/// Boxes of boxesWithin: rows of one, and its columns' unit.
constexpr int nearRows = 128, nearColumns = 64;

/// Which strips of columns have a wanted pixel in the rows [y, end).
std::vector<uint8_t> wantedStrips(View<const uint8_t> kinds, uint8_t wanted, int y, int end) {
  std::vector<uint8_t> wants(static_cast<size_t>((kinds.width + nearColumns - 1) / nearColumns),
                             uint8_t{0});
  for (; y < end; ++y)
    for (size_t strip = 0; strip < wants.size(); ++strip) {
      const uint8_t* const first = kinds.row(y) + strip * nearColumns;
      const uint8_t* const last = std::min(first + nearColumns, kinds.row(y) + kinds.width);
      if (!wants[strip]) wants[strip] = std::find(first, last, wanted) != last;
    }
  return wants;
}

}  // namespace

std::vector<LabelBox> findLabelBoxes(const SiteSearch& search) {
  requireSearchable(search);
  if (search.labels.empty()) return wholeFrame(search.kinds.width, search.kinds.height);
  return boxesOf(search.labels, [&](int y) {
    return [kind = search.wantedKinds.row(y), wanted = search.wantedKind](int x, int end) {
      while (x < end && kind[x] != wanted) ++x;
      while (x < end && kind[end - 1] != wanted) --end;
      return std::pair(x, end);
    };
  });
}

std::vector<LabelBox> findLabelBoxes(View<const uint32_t> labels, const PixelSet& wanted) {
  requireSide(wanted.width(), wanted.height());
  if (labels.empty()) return wholeFrame(wanted.width(), wanted.height());
  requireSize("the label plane", labels, wanted.width(), wanted.height());
  return boxesOf(labels, [&](int y) {
    return [&wanted, y](int x, int end) { return wanted.ends(x, end, y); };
  });
}

std::vector<LabelBox> boxesWithin(View<const uint8_t> wantedKinds, uint8_t wantedKind,
                                  float reach) {
  const int width = wantedKinds.width, height = wantedKinds.height;
  requireSide(width, height);
  const int margin = static_cast<int>(std::min(reach, static_cast<float>(longestSide))) + 1;
  const int across = (width + nearColumns - 1) / nearColumns;
  std::vector<LabelBox> boxes;
  uint64_t pixels = 0;
  for (int y = 0; y < height; y += nearRows) {
    const int end = std::min(y + nearRows, height);
    const std::vector<uint8_t> wants = wantedStrips(wantedKinds, wantedKind, y, end);
    for (int first = 0, last; first < across; first = last + 1) {
      for (last = first; last < across && wants[static_cast<size_t>(last)];) ++last;
      if (last == first) continue;
      const int x0 = first * nearColumns, x1 = std::min(last * nearColumns, width);
      LabelBox box{0,
                   0,
                   std::max(x0 - margin, 0),
                   std::max(y - margin, 0),
                   std::min(x1 + margin, width),
                   std::min(end + margin, height),
                   x0,
                   y,
                   x1,
                   end};
      box.pixels = static_cast<uint32_t>(box.x1 - box.x0) * static_cast<uint32_t>(box.y1 - box.y0);
      boxes.push_back(box);
      pixels += box.pixels;
    }
  }
  // With a long reach they overlap so much that the frame costs less.
  return pixels > wantedKinds.pixels() ? wholeFrame(width, height) : boxes;
}

bool isScattered(const LabelBox& box) {
  const uint64_t area = static_cast<uint64_t>(box.x1 - box.x0) * (box.y1 - box.y0);
  return box.pixels <= tinyLabel || area > thinBox * box.pixels;
}

void findNearestSites(const SiteSearch& search, const std::vector<LabelBox>& boxes,
                      View<uint32_t> squared, View<uint32_t> index) {
  requireSearchable(search);
  requireSize("the plane of distances", squared, search.kinds.width, search.kinds.height);
  if (!index.empty())
    requireSize("the plane of site indices", index, search.kinds.width, search.kinds.height);
  if (!search.labels.empty())
    parallelRows(squared.height, bandRows, [&](int y0, int y1) {
      for (const View<uint32_t>& plane : {squared, index})
        if (!plane.empty()) std::fill(plane.row(y0), plane.row(y1), noSite);
    });
  std::vector<LabelBox> large, small, thin;
  for (const LabelBox& box : boxes) {
    const uint64_t area = static_cast<uint64_t>(box.x1 - box.x0) * (box.y1 - box.y0);
    const bool listed = !search.labels.empty() && isScattered(box);
    (listed ? thin : (area > smallBox ? large : small)).push_back(box);
  }
  // Large boxes one after the other, so that their scratch is never held twice.
  for (const LabelBox& box : large) detail::searchBox(search, box, squared, index);
  tbb::parallel_for(size_t{0}, small.size(),
                    [&](size_t i) { detail::searchBox(search, small[i], squared, index); });
  if (!thin.empty()) detail::searchLists(search, thin, squared, index);
}

}  // namespace kagefude
