#include "passes/distance_row.h"

#include <algorithm>
#include <cstring>

#include "image/clones.h"
#include "passes/nearest_site.h"

namespace kagefude::detail {
namespace {

using Lanes = uint16_t __attribute__((vector_size(2 * rowBlock)));

/// The last column at which u's parabola is not above v's (u < v).
int crossing(const int16_t* offsets, int u, int v) {
  const int64_t fu = int64_t{offsets[u]} * offsets[u], fv = int64_t{offsets[v]} * offsets[v];
  const int64_t top = int64_t{v} * v - int64_t{u} * u + fv - fu, bottom = 2 * int64_t{v - u};
  const int64_t floored = top >= 0 ? top / bottom : -((-top + bottom - 1) / bottom);
  return static_cast<int>(std::clamp<int64_t>(floored, -1, 65535));
}

}  // namespace

KAGEFUDE_CLONES void squareRow(const int16_t* offsets, int count, uint16_t* squares) {
  for (int i = 0; i < count; ++i) {
    const int16_t away = static_cast<int16_t>(offsets[i] < 0 ? -offsets[i] : offsets[i]);
    squares[i] = away > rowReach ? farAway : static_cast<uint16_t>(away * away);
  }
}

KAGEFUDE_CLONES bool searchBlock(const uint16_t* squares, uint16_t* best) {
  Lanes lowest, here;
  std::memcpy(&lowest, best, sizeof lowest);
  std::memcpy(&here, squares, sizeof here);
  lowest = here < lowest ? here : lowest;
  bool open = true;
  for (int o = 1; o <= rowReach && open;) {
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

void Envelope::build(const int16_t* offsets, int count) {
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

uint32_t Envelope::at(const int16_t* offsets, int x) {
  if (columns_.empty()) return noSite;
  while (cursor_ + 1 < columns_.size() && starts_[cursor_ + 1] <= x) ++cursor_;
  const int64_t across = x - columns_[cursor_], down = offsets[columns_[cursor_]];
  return static_cast<uint32_t>(across * across + down * down);
}

}  // namespace kagefude::detail
