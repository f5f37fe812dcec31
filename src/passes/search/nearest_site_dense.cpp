#include "passes/search/nearest_site_dense.h"

#include <algorithm>
#include <vector>

#include "image/clones.h"
#include "image/parallel.h"
#include "passes/search/distance_row.h"

namespace kagefude::detail {
namespace {

constexpr int stripColumns = 128;

/// A run of columns of the box, and where its signed row distances go.
struct Strip {
  const uint8_t* kinds;
  const uint32_t* labels;  ///< null: no bound
  ptrdiff_t stride;
  int columns, rows;
  uint8_t siteKind;
  uint32_t label;
  int16_t* offsets;
  ptrdiff_t offsetStride;
};

/// For every pixel of the strip the signed number of rows to the nearest site in its column; the
/// upper one when two are equally near, so that the smaller y wins ties. noRow negated: none.
KAGEFUDE_CLONES void columnPhase(const Strip& s) {
  int16_t run[stripColumns];
  for (int i = 0; i < s.columns; ++i) run[i] = noRow;
  for (int y = 0; y < s.rows; ++y) {
    const uint8_t* const kind = s.kinds + y * s.stride;
    int16_t* const out = s.offsets + y * s.offsetStride;
    int16_t site[stripColumns];
    for (int i = 0; i < s.columns; ++i) site[i] = kind[i] == s.siteKind;
    if (s.labels) {
      const uint32_t* const label = s.labels + y * s.stride;
      for (int i = 0; i < s.columns; ++i)
        site[i] = static_cast<int16_t>(site[i] & (label[i] == s.label));
    }
    for (int i = 0; i < s.columns; ++i) {
      const int16_t next = static_cast<int16_t>(run[i] + (run[i] != noRow));
      out[i] = run[i] = site[i] ? int16_t{0} : next;
    }
  }
  for (int i = 0; i < s.columns; ++i) run[i] = noRow;
  for (int y = s.rows - 1; y >= 0; --y) {
    int16_t* const out = s.offsets + y * s.offsetStride;
    for (int i = 0; i < s.columns; ++i) {
      const int16_t next = static_cast<int16_t>(run[i] + (run[i] != noRow));
      run[i] = out[i] == 0 ? int16_t{0} : next;
      out[i] = out[i] <= run[i] ? static_cast<int16_t>(-out[i]) : run[i];
    }
  }
}

/// Lanes of a block: all bits where a pixel is wanted, else 0. Returns whether any is.
KAGEFUDE_CLONES bool wantedLanes(const uint8_t* kinds, uint8_t wantedKind, const uint32_t* labels,
                                 uint32_t label, int count, uint16_t* lanes) {
  uint16_t any = 0;
  for (int i = 0; i < count; ++i) lanes[i] = kinds[i] == wantedKind ? 65535 : 0;
  for (int i = count; i < rowBlock; ++i) lanes[i] = 0;
  if (labels)
    for (int i = 0; i < count; ++i) lanes[i] = labels[i] == label ? lanes[i] : uint16_t{0};
  for (int i = 0; i < rowBlock; ++i) any |= lanes[i];
  return any != 0;
}

/// Writes unwanted pixels back as they are, so only where no other thread has any in the block.
KAGEFUDE_CLONES void blendWanted(const uint16_t* wanted, const uint16_t* squared, int count,
                                 uint32_t* out) {
  for (int i = 0; i < count; ++i) out[i] = wanted[i] ? squared[i] : out[i];
}

/// Second phase for the wanted pixels of a band of rows.
class RowPhase {
 public:
  RowPhase(const SiteSearch& search, const LabelBox& box, View<const int16_t> offsets,
           View<uint32_t> squared, View<uint32_t> index)
      : search_(search),
        box_(box),
        offsets_(offsets),
        squared_(squared),
        index_(index),
        squares_(static_cast<size_t>(offsets.width) + 2 * rowPad, farAway),
        padded_(index.empty() ? 0 : squares_.size(), noRow) {}

  void run(int y) {
    row_ = offsets_.row(y - box_.y0);
    squaresReady_ = envelopeReady_ = false;
    if (search_.labels.empty())
      for (const View<uint32_t>& plane : {squared_, index_})
        if (!plane.empty())
          std::fill(plane.row(y) + box_.wantedX0, plane.row(y) + box_.wantedX1, noSite);
    for (int x = box_.wantedX0; x < box_.wantedX1; x += rowBlock) {
      uint16_t wanted[rowBlock];
      const int count = std::min(rowBlock, box_.wantedX1 - x);
      const uint32_t* const labels = search_.labels.empty() ? nullptr : search_.labels.row(y) + x;
      if (wantedLanes(search_.wantedKinds.row(y) + x, search_.wantedKind, labels, box_.label, count,
                      wanted))
        searchWanted(x, y, count, wanted);
    }
  }

 private:
  void prepareSquares() {
    squareRow(row_, offsets_.width, squares_.data() + rowPad);
    if (!padded_.empty()) std::copy_n(row_, offsets_.width, padded_.data() + rowPad);
    squaresReady_ = true;
  }

  void searchWanted(int x, int y, int count, const uint16_t* wanted) {
    if (!squaresReady_) prepareSquares();
    uint16_t best[rowBlock];
    std::copy_n(wanted, rowBlock, best);
    const int column = x - box_.x0;
    if (!envelopeReady_ && searchBlock(squares_.data() + rowPad + column, best)) {
      storeSquared(x, y, count, wanted, best);
      if (!index_.empty()) storeBlockSites(x, y, count, wanted, best);
      return;
    }
    if (!envelopeReady_) envelope_.build(row_, offsets_.width);
    envelopeReady_ = true;
    for (int i = 0; i < count; ++i) {
      if (!wanted[i]) continue;
      squared_(x + i, y) = envelope_.at(row_, column + i);
      if (!index_.empty() && squared_(x + i, y) != noSite)
        index_(x + i, y) = indexOf(box_.x0 + envelope_.column(), y + row_[envelope_.column()]);
    }
  }

  void storeSquared(int x, int y, int count, const uint16_t* wanted, const uint16_t* squared) {
    uint32_t* const out = squared_.row(y) + x;
    if (search_.labels.empty()) {
      blendWanted(wanted, squared, count, out);
      return;
    }
    for (int i = 0; i < count; ++i)
      if (wanted[i]) out[i] = squared[i];
  }

  void storeBlockSites(int x, int y, int count, const uint16_t* wanted, const uint16_t* squared) {
    int16_t across[rowBlock], down[rowBlock];
    const int at = rowPad + x - box_.x0;
    findBlockSites(squares_.data() + at, padded_.data() + at, squared, across, down);
    for (int i = 0; i < count; ++i)
      if (wanted[i]) index_(x + i, y) = indexOf(x + i + across[i], y + down[i]);
  }

  uint32_t indexOf(int x, int y) const {
    return static_cast<uint32_t>(y) * static_cast<uint32_t>(squared_.width) +
           static_cast<uint32_t>(x);
  }

  const SiteSearch& search_;
  const LabelBox& box_;
  View<const int16_t> offsets_;
  View<uint32_t> squared_, index_;
  std::vector<uint16_t> squares_;
  std::vector<int16_t> padded_;  ///< the row's offsets, where indices are wanted
  Envelope envelope_;
  const int16_t* row_ = nullptr;
  bool squaresReady_ = false, envelopeReady_ = false;
};

}  // namespace

void searchBox(const SiteSearch& search, const LabelBox& box, View<uint32_t> squared,
               View<uint32_t> index) {
  const int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  Plane<int16_t> offsets(columns, rows);
  parallelRows((columns + stripColumns - 1) / stripColumns, 1, [&](int first, int) {
    const int x = first * stripColumns;
    const View<const uint32_t>& labels = search.labels;
    columnPhase({search.kinds.row(box.y0) + box.x0 + x,
                 labels.empty() ? nullptr : labels.row(box.y0) + box.x0 + x, search.kinds.width,
                 std::min(stripColumns, columns - x), rows, search.siteKind, box.label,
                 offsets.row(0) + x, columns});
  });
  parallelRows(box.wantedY1 - box.wantedY0, 16, [&](int first, int end) {
    RowPhase phase(search, box, offsets, squared, index);
    for (int y = box.wantedY0 + first; y < box.wantedY0 + end; ++y) phase.run(y);
  });
}

}  // namespace kagefude::detail
