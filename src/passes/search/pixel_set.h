#pragma once

#include <bit>
#include <utility>
#include <vector>

#include "image/plane.h"

namespace kagefude {

/// Some of a frame's pixels, numbered in raster order, so that what is computed for them alone can
/// be kept without gaps. 12 bytes for 64 pixels of the frame.
class PixelSet {
 public:
  PixelSet() = default;
  /// The pixels whose kind is in [lowest, highest]. Cost: one read of the plane.
  PixelSet(View<const uint8_t> kinds, uint8_t lowest, uint8_t highest);

  int width() const { return width_; }
  int height() const { return height_; }
  size_t size() const { return size_; }
  bool contains(int x, int y) const { return wordAt(x, y) >> (x & 63) & 1; }
  /// Number of the first pixel of the set that is not before (x, y) in its row's group of 64: of
  /// (x, y) itself when the set has it.
  uint32_t indexOf(int x, int y) const {
    const uint64_t before = wordAt(x, y) & ((uint64_t{1} << (x & 63)) - 1);
    return first_[at(x, y)] + static_cast<uint32_t>(std::popcount(before));
  }
  /// The first pixel of the set in [x, end) of a row, and the one behind the last; equal ones when
  /// there is none.
  std::pair<int, int> ends(int x, int end, int y) const;
  /// Bit i: whether the set has (x + i, y). x: a multiple of 32, in the frame.
  uint32_t bits32(int x, int y) const { return static_cast<uint32_t>(wordAt(x, y) >> (x & 32)); }

 private:
  size_t at(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(perRow_) + static_cast<size_t>(x >> 6);
  }
  uint64_t wordAt(int x, int y) const { return words_[at(x, y)]; }

  int width_ = 0, height_ = 0, perRow_ = 0;
  size_t size_ = 0;
  std::vector<uint64_t> words_;
  std::vector<uint32_t> first_;  ///< number of each word's first pixel
};

}  // namespace kagefude
