#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// Points of a round light, of which some are hidden: a bit a point.
struct HiddenPoints {
  std::array<uint64_t, 4> words{};

  int count() const;
  bool all() const { return (words[0] & words[1] & words[2] & words[3]) == ~uint64_t{0}; }
};

/// 256 points of equal areas of a round light, and which of them a rectangle hides: read from
/// tables that part the points by either coordinate, to 1/128 of the radius (Schwarz & Stamminger
/// 2007). The unit disc is the light's.
class LightPoints {
 public:
  static constexpr int size = 256;

  LightPoints();

  /// Hides the points in [x0, x1) x [y0, y1).
  void hideRectangle(float x0, float x1, float y0, float y1, HiddenPoints& hidden) const {
    const Words &left = belowX_[cellOf(x0)], &right = belowX_[cellOf(x1)];
    const Words &upper = belowY_[cellOf(y0)], &lower = belowY_[cellOf(y1)];
    for (size_t k = 0; k < left.size(); ++k)
      hidden.words[k] |= right[k] & ~left[k] & lower[k] & ~upper[k];
  }

  /// Hides the points where middle + x·slope.x + y·slope.y is not above 0.
  void hideBelow(float middle, const V2f& slope, HiddenPoints& hidden) const;

 private:
  using Words = std::array<uint64_t, 4>;
  static constexpr int cells = 256;  ///< over [-1, 1)

  static size_t cellOf(float x) {
    const float cell = (x + 1) * (cells / 2);
    return static_cast<size_t>(cell > 0 ? (cell < cells ? cell : cells) : 0);
  }

  std::vector<V2f> points_;
  std::vector<Words> belowX_, belowY_;  ///< points before each cell
};

}  // namespace kagefude
