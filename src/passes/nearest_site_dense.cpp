#include "passes/nearest_site_dense.h"

#include <cstring>

#include "image/clones.h"
#include "image/parallel.h"

namespace kagefude::detail {
namespace {

constexpr int16_t noRow = 32767;     ///< no site of the label in this column
constexpr uint16_t farAway = 32767;  ///< squared row distance of a site that is out of reach
constexpr int reach = 180;           ///< reach² + farAway still fits 16 bits
constexpr int block = 32;
constexpr int stripColumns = 64;
using Lanes = uint16_t __attribute__((vector_size(2 * block)));

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

/// Squares a row of offsets; those out of reach become farAway.
KAGEFUDE_CLONES void squareRow(const int16_t* offsets, int count, uint16_t* squares) {
  for (int i = 0; i < count; ++i) {
    const int16_t away = static_cast<int16_t>(offsets[i] < 0 ? -offsets[i] : offsets[i]);
    squares[i] = away > reach ? farAway : static_cast<uint16_t>(away * away);
  }
}

/// Smallest squares[x ± o] + o² for a block of pixels; lanes start at `best`, 0 where no answer is
/// wanted. Returns false when a lane may have a nearer site out of reach.
KAGEFUDE_CLONES bool searchBlock(const uint16_t* squares, uint16_t* best) {
  Lanes lowest, here;
  std::memcpy(&lowest, best, sizeof lowest);
  std::memcpy(&here, squares, sizeof here);
  lowest = here < lowest ? here : lowest;
  bool open = true;
  for (int o = 1; o <= reach && open;) {
    for (const int end = o + 4; o < end; ++o) {
      Lanes left, right;
      std::memcpy(&left, squares - o, sizeof left);
      std::memcpy(&right, squares + o, sizeof right);
      const Lanes near = (left < right ? left : right) + static_cast<uint16_t>(o * o);
      lowest = near < lowest ? near : lowest;
    }
    // The next offset is o: nothing nearer than o² is left to find.
    const Lanes above = (Lanes)(lowest > static_cast<uint16_t>(o * o));
    uint64_t words[sizeof above / 8];
    std::memcpy(words, &above, sizeof above);
    uint64_t any = 0;
    for (const uint64_t word : words) any |= word;
    open = any != 0;
  }
  std::memcpy(best, &lowest, sizeof lowest);
  return !open;
}

/// Lower envelope of the parabolas (x - u)² + offset(u)² of one row, exact at any distance.
class Envelope {
 public:
  void build(const int16_t* offsets, int count) {
    columns_.clear();
    starts_.clear();
    for (int u = 0; u < count; ++u) {
      if (offsets[u] == noRow || offsets[u] == -noRow) continue;
      int start = 0;
      while (!columns_.empty()) {
        start = crossing(offsets, columns_.back(), u) + 1;
        if (start > starts_.back()) break;
        columns_.pop_back();
        starts_.pop_back();
        start = 0;
      }
      if (start >= count) continue;
      columns_.push_back(u);
      starts_.push_back(start);
    }
    cursor_ = 0;
  }

  /// Squared distance at column x; x must not fall between calls after one build.
  uint32_t at(const int16_t* offsets, int x) {
    if (columns_.empty()) return noSite;
    while (cursor_ + 1 < columns_.size() && starts_[cursor_ + 1] <= x) ++cursor_;
    const int64_t across = x - columns_[cursor_], down = offsets[columns_[cursor_]];
    return static_cast<uint32_t>(across * across + down * down);
  }

 private:
  /// The last column at which u's parabola is not above v's (u < v).
  static int crossing(const int16_t* offsets, int u, int v) {
    const int64_t fu = int64_t{offsets[u]} * offsets[u], fv = int64_t{offsets[v]} * offsets[v];
    const int64_t top = int64_t{v} * v - int64_t{u} * u + fv - fu, bottom = 2 * int64_t{v - u};
    const int64_t floored = top >= 0 ? top / bottom : -((-top + bottom - 1) / bottom);
    return static_cast<int>(std::clamp<int64_t>(floored, -1, 65535));
  }

  std::vector<int> columns_, starts_;
  size_t cursor_ = 0;
};

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
        squares_(static_cast<size_t>(offsets.width) + 2 * pad, farAway) {}

  void run(int y) {
    row_ = offsets_.row(y - box_.y0);
    squared16Ready_ = envelopeReady_ = false;
    for (int x = box_.wantedX0; x < box_.wantedX1; x += block) {
      uint16_t best[block];
      if (wantedLanes(x, y, best)) searchWanted(x, y, best);
    }
  }

 private:
  static constexpr int pad = reach + 4 + block;

  /// Sets lanes to the largest value where the block's pixels are wanted, else to 0.
  bool wantedLanes(int x, int y, uint16_t* lanes) const {
    const uint8_t* const kind = search_.wantedKinds.row(y) + x;
    const int count = std::min(block, box_.wantedX1 - x);
    int found = 0;
    for (int i = 0; i < count; ++i) found += kind[i] == search_.wantedKind;
    if (found == 0) return false;
    for (int i = 0; i < block; ++i)
      lanes[i] = i < count && kind[i] == search_.wantedKind && inLabel(x + i, y) ? 65535 : 0;
    uint16_t any = 0;
    for (int i = 0; i < block; ++i) any |= lanes[i];
    return any != 0;
  }

  bool inLabel(int x, int y) const {
    return search_.labels.empty() || search_.labels(x, y) == box_.label;
  }

  void searchWanted(int x, int y, uint16_t* best) {
    if (!squared16Ready_) squareRow(row_, offsets_.width, squares_.data() + pad);
    squared16Ready_ = true;
    uint16_t wanted[block];
    std::memcpy(wanted, best, sizeof wanted);
    const bool done = !envelopeReady_ && searchBlock(squares_.data() + pad + (x - box_.x0), best);
    if (!done && !envelopeReady_) {
      envelope_.build(row_, offsets_.width);
      envelopeReady_ = true;
    }
    for (int i = 0; i < block; ++i) {
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
