#pragma once

#include <vector>

#include "image/plane.h"

namespace kagefude {

/// How far round every pixel a label plane is the same, in blocks of 8x8 pixels.
class UniformBlocks {
 public:
  /// Cost: one read of the labels.
  explicit UniformBlocks(View<const uint32_t> labels);

  /// All pixels up to so many pixels left, right, above and below are in the frame and of the
  /// pixel's label; negative when not even its block is known to be. At most 2032.
  int margin(int x, int y) const {
    return (around_[static_cast<size_t>(y / side) * static_cast<size_t>(blocksX_) +
                    static_cast<size_t>(x / side)] -
            1) *
           side;
  }

 private:
  static constexpr int side = 8;
  int blocksX_, blocksY_;
  /// How many blocks to every side, and 1, are of one label with a block; 0: not even its own
  /// pixels are.
  std::vector<uint8_t> around_;
};

}  // namespace kagefude
