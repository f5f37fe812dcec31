#pragma once

#include <array>

#include "passes/casters/seen_surface.h"
#include "passes/casters/shadow_wedges.h"

namespace kagefude {

inline constexpr int coverageTile = 8;

/// Boxes round what the pixels of one tile show, from P alone, for culling. A smooth pixel's box
/// reaches half way to its neighbours. An edge pixel, beside another object or beside a jump of its
/// own, may show anything between and has no box. Relative to the camera's eye.
class PixelBoxes {
 public:
  /// The tile has its corner at (x0, y0) and is cut at the picture's edge. With `centres` boxes
  /// hold little more than the centres, and every surface pixel is smooth.
  PixelBoxes(const SeenSurface& surface, int x0, int y0, bool centres);

  /// Box of the smooth pixels in the rectangle, in pixels of the tile; false when there is none.
  /// `stretched` tells that it holds much more than the pixels' own sizes account for: surfaces
  /// apart from each other.
  bool around(int x0, int y0, int x1, int y1, PointBox& box, bool& stretched) const;
  bool smooth(int x, int y) const { return kind(x, y) == Kind::smooth; }
  bool edge(int x, int y) const { return kind(x, y) == Kind::edge; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// The largest pixel of the tile in world units, and the distance of its farthest point.
  float pixelSize() const { return pixelSize_; }
  float reach() const { return reach_; }

 private:
  enum class Kind : uint8_t { background, smooth, edge };
  struct Extent {
    V3f low{0, 0, 0}, high{0, 0, 0};
    float size = 0;
    Kind kind = Kind::background;
  };
  Kind kind(int x, int y) const { return pixels_[y * coverageTile + x].kind; }
  void measure(const SeenSurface& surface, int x, int y, bool centres, Extent& extent);

  std::array<Extent, coverageTile * coverageTile> pixels_;
  int width_, height_;
  float pixelSize_ = 0, reach_ = 0;
};

}  // namespace kagefude
