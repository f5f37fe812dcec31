#include "passes/nearest_site_dense.h"

#include <cstring>

#include "image/clones.h"
#include "image/parallel.h"
#include "passes/distance_row.h"

namespace kagefude::detail {
namespace {

constexpr int stripColumns = 64;

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

/// Index of the site at squared distance d2 from (x, y): the smallest y, then the smallest x.
uint32_t siteIndexAt(const int16_t* offsets, int count, int x, int y, uint32_t d2, int x0,
                     int width) {
  int bestY = 1 << 30, bestX = 0;
  for (int o = 0; int64_t{o} * o <= d2; ++o)
    for (const int u : {x - o, x + o}) {
      if (u < 0 || u >= count) continue;
      const int64_t down = offsets[u];
      if (down * down + int64_t{o} * o != d2) continue;
      const int siteY = y + static_cast<int>(down);
      if (siteY < bestY || (siteY == bestY && u < bestX)) {
        bestY = siteY;
        bestX = u;
      }
    }
  return static_cast<uint32_t>(bestY) * static_cast<uint32_t>(width) +
         static_cast<uint32_t>(x0 + bestX);
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
        squares_(static_cast<size_t>(offsets.width) + 2 * rowPad, farAway) {}

  void run(int y) {
    row_ = offsets_.row(y - box_.y0);
    squared16Ready_ = envelopeReady_ = false;
    for (int x = box_.wantedX0; x < box_.wantedX1; x += rowBlock) {
      uint16_t best[rowBlock];
      if (wantedLanes(x, y, best)) searchWanted(x, y, best);
    }
  }

 private:
  /// Sets lanes to the largest value where the block's pixels are wanted, else to 0.
  bool wantedLanes(int x, int y, uint16_t* lanes) const {
    const uint8_t* const kind = search_.wantedKinds.row(y) + x;
    const int count = std::min(rowBlock, box_.wantedX1 - x);
    int found = 0;
    for (int i = 0; i < count; ++i) found += kind[i] == search_.wantedKind;
    if (found == 0) return false;
    for (int i = 0; i < rowBlock; ++i)
      lanes[i] = i < count && kind[i] == search_.wantedKind && inLabel(x + i, y) ? 65535 : 0;
    uint16_t any = 0;
    for (int i = 0; i < rowBlock; ++i) any |= lanes[i];
    return any != 0;
  }

  bool inLabel(int x, int y) const {
    return search_.labels.empty() || search_.labels(x, y) == box_.label;
  }

  void searchWanted(int x, int y, uint16_t* best) {
    if (!squared16Ready_) squareRow(row_, offsets_.width, squares_.data() + rowPad);
    squared16Ready_ = true;
    uint16_t wanted[rowBlock];
    std::memcpy(wanted, best, sizeof wanted);
    const bool done =
        !envelopeReady_ && searchBlock(squares_.data() + rowPad + (x - box_.x0), best);
    if (!done && !envelopeReady_) {
      envelope_.build(row_, offsets_.width);
      envelopeReady_ = true;
    }
    for (int i = 0; i < rowBlock; ++i) {
      if (!wanted[i]) continue;
      const int column = x + i - box_.x0;
      const uint32_t d2 = done ? best[i] : envelope_.at(row_, column);
      squared_(x + i, y) = d2;
      if (!index_.empty() && d2 != noSite)
        index_(x + i, y) =
            siteIndexAt(row_, offsets_.width, column, y, d2, box_.x0, squared_.width);
    }
  }

  const SiteSearch& search_;
  const LabelBox& box_;
  View<const int16_t> offsets_;
  View<uint32_t> squared_, index_;
  std::vector<uint16_t> squares_;
  Envelope envelope_;
  const int16_t* row_ = nullptr;
  bool squared16Ready_ = false, envelopeReady_ = false;
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
