#include "passes/search/pixel_set.h"

#include <cstring>

#include "image/clones.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

/// Flags of up to 64 kinds as bits.
KAGEFUDE_CLONES uint64_t gatherBits(const uint8_t* kinds, int count, uint8_t lowest,
                                    uint8_t highest) {
  uint8_t flag[64] = {};
  for (int i = 0; i < count; ++i) flag[i] = kinds[i] >= lowest && kinds[i] <= highest;
  uint64_t bits = 0;
  for (int i = 0; i < 8; ++i) {
    uint64_t eight;
    std::memcpy(&eight, flag + 8 * i, sizeof eight);
    if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
    // Eight bytes of 0 or 1 become eight bits.
    bits |= (eight * 0x0102040810204080u >> 56) << (8 * i);
  }
  return bits;
}

}  // namespace

PixelSet::PixelSet(View<const uint8_t> kinds, uint8_t lowest, uint8_t highest)
    : width_(kinds.width), height_(kinds.height), perRow_((kinds.width + 63) / 64) {
  const size_t words = static_cast<size_t>(perRow_) * static_cast<size_t>(height_);
  words_.resize(words);
  first_.resize(words);
  parallelRows(height_, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < width_; x += 64)
        words_[at(x, y)] = gatherBits(kinds.row(y) + x, std::min(64, width_ - x), lowest, highest);
  });
  for (size_t i = 0; i < words; ++i) {
    first_[i] = static_cast<uint32_t>(size_);
    size_ += static_cast<size_t>(std::popcount(words_[i]));
  }
}

std::pair<int, int> PixelSet::ends(int x, int end, int y) const {
  int first = end, last = end;
  for (int from = x; from < end; from = (from | 63) + 1) {
    uint64_t bits = wordAt(from, y) >> (from & 63);
    if (const int count = std::min(end - from, 64 - (from & 63)); count < 64)
      bits &= (uint64_t{1} << count) - 1;
    if (!bits) continue;
    if (first == end) first = from + std::countr_zero(bits);
    last = from + 64 - std::countl_zero(bits);
  }
  return {first, last};
}

}  // namespace kagefude
