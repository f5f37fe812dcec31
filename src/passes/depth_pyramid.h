#pragma once

#include <vector>

#include "image/plane.h"

namespace kagefude {

struct DepthRange {
  float nearest, farthest;
};

/// Smallest and largest depth over any rectangle of a shadow map, conservatively, in constant time.
/// NaN depths count as infinitely far. Cost: one read of the map; 2/3 of its bytes.
class DepthPyramid {
 public:
  explicit DepthPyramid(View<const float> depth);

  /// Bounds over the texels [x0, x1] x [y0, y1], which must touch the map; the range may include
  /// texels around the rectangle.
  DepthRange range(int x0, int y0, int x1, int y1) const;

 private:
  DepthRange at(int level, int x, int y) const;

  View<const float> depth_;
  std::vector<Floats> nearest_, farthest_;  ///< level 1 and up; each halves the one below
};

}  // namespace kagefude
