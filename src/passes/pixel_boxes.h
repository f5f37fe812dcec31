#pragma once

#include <array>

#include "passes/seen_surface.h"
#include "passes/shadow_wedges.h"

namespace kagefude {

inline constexpr int coverageTile = 8;

/// Boxes round what the pixels of one tile show, from P alone, for culling: a pixel's box reaches
/// half way to its neighbours (as far on the side where a neighbour is missing) and takes in the
/// neighbouring surface at a silhouette. Relative to the camera's eye.
class PixelBoxes {
 public:
  /// The tile has its corner at (x0, y0) and is cut at the picture's edge. With `centres` boxes
  /// hold the centres only.
  PixelBoxes(const SeenSurface& surface, int x0, int y0, bool centres);

  /// Box of the surface pixels in the rectangle, in pixels of the tile; false when there is none.
  bool around(int x0, int y0, int x1, int y1, PointBox& box) const;
  bool present(int x, int y) const { return pixels_[y * coverageTile + x].present; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// The largest pixel of the tile in world units, and the distance of its farthest point.
  float pixelSize() const { return pixelSize_; }
  float reach() const { return reach_; }

 private:
  struct Extent {
    V3f low, high;
    bool present = false;
  };
  void measure(const SeenSurface& surface, int x, int y, bool centres, Extent& extent);

  std::array<Extent, coverageTile * coverageTile> pixels_;
  int width_, height_;
  float pixelSize_ = 0, reach_ = 0;
};

}  // namespace kagefude
