#include "passes/search/distance_row.h"

#include <algorithm>
#include <cstring>

#include "image/clones.h"
#include "passes/search/nearest_site.h"

namespace kagefude::detail {
namespace {

// Comparisons are written as selects: a bare one of 64 bytes is taken apart lane by lane.
using Lanes = uint16_t __attribute__((vector_size(2 * rowBlock)));

constexpr Lanes everyBit = ~Lanes{};

/// The first column at which v's site is to be had instead of u's (u < v): it is nearer, or as near
/// and in an upper row.
int takeover(const int16_t* offsets, int u, int v) {
  const int64_t fu = int64_t{offsets[u]} * offsets[u], fv = int64_t{offsets[v]} * offsets[v];
  const int64_t top = int64_t{v} * v - int64_t{u} * u + fv - fu, bottom = 2 * int64_t{v - u};
  const int64_t floored = top >= 0 ? top / bottom : -((-top + bottom - 1) / bottom);
  const bool atOnce = floored * bottom == top && offsets[v] < offsets[u];
  return static_cast<int>(std::clamp<int64_t>(floored + (atOnce ? 0 : 1), 0, 65535));
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
      const auto square = static_cast<uint16_t>(o * o);
      const Lanes least = left < right ? left : right,
                  most = Lanes{} + static_cast<uint16_t>(farAway - square);
      const Lanes near = (least < most ? least : most) + square;
      lowest = near < lowest ? near : lowest;
    }
    // The next offset is o: nothing nearer than o² is left to find.
    const Lanes above = lowest > static_cast<uint16_t>(o * o) ? everyBit : Lanes{};
    uint64_t words[sizeof above / 8];
    std::memcpy(words, &above, sizeof above);
    uint64_t any = 0;
    for (const uint64_t word : words) any |= word;
    open = any != 0;
  }
  std::memcpy(best, &lowest, sizeof lowest);
  return !open;
}

KAGEFUDE_CLONES void findBlockSites(const uint16_t* squares, const int16_t* offsets,
                                    const uint16_t* squared, int16_t* across, int16_t* down) {
  int16_t bestDown[rowBlock], bestAcross[rowBlock] = {};
  uint16_t farthest = 0;
  for (int i = 0; i < rowBlock; ++i) {
    bestDown[i] = noRow;
    farthest = std::max(farthest, squared[i]);
  }
  for (int o = 0; o * o <= farthest; ++o)
    for (const int at : {-o, o}) {
      const auto square = static_cast<uint16_t>(o * o);
      const auto aside = static_cast<int16_t>(at);
      for (int i = 0; i < rowBlock; ++i) {
        const auto left = static_cast<uint16_t>(squared[i] - square);
        const bool better =
            (squares[at + i] == left) & (squared[i] >= square) & (offsets[at + i] < bestDown[i]);
        bestDown[i] = better ? offsets[at + i] : bestDown[i];
        bestAcross[i] = better ? aside : bestAcross[i];
      }
    }
  std::copy_n(bestAcross, rowBlock, across);
  std::copy_n(bestDown, rowBlock, down);
}

void Envelope::build(const int16_t* offsets, int count) {
  columns_.clear();
  starts_.clear();
  for (int u = 0; u < count; ++u) {
    if (offsets[u] == noRow || offsets[u] == -noRow) continue;
    int start = 0;
    while (!columns_.empty()) {
      start = takeover(offsets, columns_.back(), u);
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
