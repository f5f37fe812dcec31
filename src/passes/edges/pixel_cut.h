#pragma once

#include <array>

namespace kagefude {

/// Half of the picture's plane: where constant + x·dx + y·dy > 0, with dx, dy in pixels from a
/// pixel's centre, y downward.
struct HalfPlane {
  double constant = 0, x = 0, y = 0;

  double at(double dx, double dy) const { return constant + x * dx + y * dy; }
};

/// What is left of a pixel's square while half planes are cut off it, exactly. Nine corners are
/// room for five cuts and more: each adds one to the four at most.
class PixelCut {
 public:
  /// Takes away what lies in `half`. Beyond eight cuts nothing is taken.
  void take(const HalfPlane& half);

  /// Area that is left, 0..1 pixel.
  double area() const;

 private:
  struct Corner {
    double x, y;
  };
  static constexpr int room = 12;

  std::array<Corner, room> corners_{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  int count_ = 4;
};

}  // namespace kagefude
