#include "passes/light_shape/mask_distance_box.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "image/parallel.h"
#include "passes/light_shape/mask_distance.h"

namespace kagefude::detail {
namespace {

constexpr float farthest = 2000.0f;
constexpr int stripColumns = 64;
constexpr int bandRows = 16;

/// A run of columns of the box, and where their row distances go.
struct Strip {
  const uint8_t* mask;
  const uint32_t* labels;  ///< null: no bound
  ptrdiff_t stride;
  int columns, rows;
  uint32_t label;
  int16_t *toDark, *toLit;
  ptrdiff_t outStride;
};

constexpr int16_t oneRowOn(int16_t rows) { return static_cast<int16_t>(rows + (rows != noRow)); }

/// For every pixel of the strip the rows to the nearest dark and to the nearest lit pixel of the
/// label in its column, noRow where there is none.
KAGEFUDE_CLONES void columnPhase(const Strip& s) {
  int16_t dark[stripColumns], lit[stripColumns], inside[stripColumns];
  for (int i = 0; i < stripColumns; ++i) dark[i] = lit[i] = noRow, inside[i] = 1;
  for (int y = 0; y < s.rows; ++y) {
    const uint8_t* const mask = s.mask + y * s.stride;
    int16_t *const toDark = s.toDark + y * s.outStride, *const toLit = s.toLit + y * s.outStride;
    if (s.labels) {
      const uint32_t* const label = s.labels + y * s.stride;
      for (int i = 0; i < s.columns; ++i) inside[i] = label[i] == s.label;
    }
    for (int i = 0; i < s.columns; ++i) {
      const int16_t seen = mask[i] != 0;
      toDark[i] = dark[i] = inside[i] > seen ? int16_t{0} : oneRowOn(dark[i]);
      toLit[i] = lit[i] = (inside[i] & seen) ? int16_t{0} : oneRowOn(lit[i]);
    }
  }
  for (int i = 0; i < stripColumns; ++i) dark[i] = lit[i] = noRow;
  for (int y = s.rows - 1; y >= 0; --y) {
    int16_t *const toDark = s.toDark + y * s.outStride, *const toLit = s.toLit + y * s.outStride;
    for (int i = 0; i < s.columns; ++i) {
      toDark[i] = dark[i] = std::min(toDark[i], oneRowOn(dark[i]));
      toLit[i] = lit[i] = std::min(toLit[i], oneRowOn(lit[i]));
    }
  }
}

/// The wanted pixels of a block that show a kind, as lanes for searchBlock.
struct BlockLanes {
  uint16_t lit[rowBlock], dark[rowBlock];
};

KAGEFUDE_CLONES void splitLanes(uint32_t wanted, const uint8_t* mask, const uint32_t* labels,
                                uint32_t label, int count, BlockLanes& lanes) {
  uint16_t take[rowBlock], seen[rowBlock] = {};
  for (int i = 0; i < rowBlock; ++i) take[i] = (wanted >> i & 1) ? 65535 : 0;
  for (int i = 0; i < count; ++i) seen[i] = mask[i] ? 65535 : 0;
  if (labels)
    for (int i = 0; i < count; ++i) take[i] = labels[i] == label ? take[i] : uint16_t{0};
  for (int i = 0; i < rowBlock; ++i) {
    lanes.lit[i] = static_cast<uint16_t>(take[i] & seen[i]);
    lanes.dark[i] = static_cast<uint16_t>(take[i] & ~seen[i]);
  }
}

/// Distances of a block whose squares fit 16 bits; all of them are in reach.
KAGEFUDE_CLONES void storeNear(const uint16_t* squared, float sign, int16_t* out) {
  for (int i = 0; i < rowBlock; ++i) {
    const float d = std::sqrt(static_cast<float>(squared[i])) - 0.5f;
    out[i] = static_cast<int16_t>(sign * (d / distanceUnit + 0.5f));
  }
}

/// One kind of site in a row, and what its search needs.
class KindRow {
 public:
  explicit KindRow(int columns)
      : columns_(columns), squares_(static_cast<size_t>(columns) + 2 * rowPad, farAway) {}

  void start(const int16_t* offsets) {
    offsets_ = offsets;
    squared_ = enveloped_ = false;
  }

  /// Signed distances of the lanes that are not 0, for the block that starts at `column` of the box
  /// (possibly before it); the rest of `out` is arbitrary.
  void measure(uint16_t* lanes, int column, bool lit, int16_t* out) {
    if (!squared_) squareRow(offsets_, columns_, squares_.data() + rowPad);
    squared_ = true;
    uint16_t wanted[rowBlock];
    std::copy_n(lanes, rowBlock, wanted);
    if (!enveloped_ && searchBlock(squares_.data() + rowPad + column, lanes)) {
      storeNear(lanes, lit ? 1.0f : -1.0f, out);
      return;
    }
    if (!enveloped_) envelope_.build(offsets_, columns_);
    enveloped_ = true;
    for (int i = 0; i < rowBlock; ++i)
      if (wanted[i]) out[i] = signedDistance(envelope_.at(offsets_, column + i), lit);
  }

 private:
  int columns_;
  std::vector<uint16_t> squares_;
  Envelope envelope_;
  const int16_t* offsets_ = nullptr;
  bool squared_ = false, enveloped_ = false;
};

/// Second phase for the wanted pixels of some rows.
class RowPhase {
 public:
  RowPhase(const MaskBox& task, const BoxScratch& scratch)
      : task_(task),
        scratch_(scratch),
        columns_(task.box.x1 - task.box.x0),
        dark_(columns_),
        lit_(columns_) {}

  void run(int y) {
    const ptrdiff_t row = static_cast<ptrdiff_t>(y - task_.box.y0) * columns_;
    dark_.start(scratch_.toDark.data() + row);
    lit_.start(scratch_.toLit.data() + row);
    for (int x = task_.box.wantedX0 / rowBlock * rowBlock; x < task_.box.wantedX1; x += rowBlock)
      if (const uint32_t bits = task_.wanted.bits32(x, y)) measure(x, y, bits);
  }

 private:
  void measure(int x, int y, uint32_t bits) {
    BlockLanes lanes;
    splitLanes(bits, task_.mask.row(y) + x,
               task_.labels.empty() ? nullptr : task_.labels.row(y) + x, task_.box.label,
               std::min(rowBlock, task_.mask.width - x), lanes);
    uint32_t seen = 0, hidden = 0;
    for (int i = 0; i < rowBlock; ++i) {
      seen |= static_cast<uint32_t>(lanes.lit[i] & 1) << i;
      hidden |= static_cast<uint32_t>(lanes.dark[i] & 1) << i;
    }
    const int column = x - task_.box.x0;
    int16_t ofLit[rowBlock], ofDark[rowBlock];
    if (seen) dark_.measure(lanes.lit, column, true, ofLit);
    if (hidden) lit_.measure(lanes.dark, column, false, ofDark);
    int16_t* out = task_.distances + task_.wanted.indexOf(x, y);
    for (uint32_t left = bits; left; left &= left - 1, ++out) {
      const int i = std::countr_zero(left);
      if (seen >> i & 1) *out = ofLit[i];
      if (hidden >> i & 1) *out = ofDark[i];
    }
  }

  const MaskBox& task_;
  const BoxScratch& scratch_;
  int columns_;
  KindRow dark_, lit_;
};

}  // namespace

int16_t signedDistance(uint32_t squared, bool lit) {
  const float d = std::sqrt(static_cast<float>(squared)) - 0.5f;
  if (squared == noSite || d > farthest) return lit ? farLit : farDark;
  return static_cast<int16_t>((lit ? 1.0f : -1.0f) * (d / distanceUnit + 0.5f));
}

void measureBox(const MaskBox& task, BoxScratch& scratch, bool parallel) {
  const LabelBox& box = task.box;
  const int columns = box.x1 - box.x0, rows = box.y1 - box.y0;
  const size_t pixels = static_cast<size_t>(columns) * static_cast<size_t>(rows);
  for (std::vector<int16_t>* offsets : {&scratch.toDark, &scratch.toLit})
    if (offsets->size() < pixels) offsets->resize(pixels);
  const auto strip = [&](int first) {
    const int x = first * stripColumns;
    const View<const uint32_t>& labels = task.labels;
    columnPhase({task.mask.row(box.y0) + box.x0 + x,
                 labels.empty() ? nullptr : labels.row(box.y0) + box.x0 + x, task.mask.width,
                 std::min(stripColumns, columns - x), rows, box.label, scratch.toDark.data() + x,
                 scratch.toLit.data() + x, columns});
  };
  const auto band = [&](int first, int end) {
    RowPhase phase(task, scratch);
    for (int y = box.wantedY0 + first; y < box.wantedY0 + end; ++y) phase.run(y);
  };
  const int strips = (columns + stripColumns - 1) / stripColumns;
  const int wantedRows = box.wantedY1 - box.wantedY0;
  if (parallel) {
    parallelRows(strips, 1, [&](int first, int) { strip(first); });
    parallelRows(wantedRows, bandRows, band);
  } else {
    for (int i = 0; i < strips; ++i) strip(i);
    band(0, wantedRows);
  }
}

}  // namespace kagefude::detail
