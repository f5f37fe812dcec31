#include "picture/turn_picture.h"

#include <utility>

namespace kagefude {

Floats turnedUpright(Floats plane, int orientation) {
  if (orientation < 2 || orientation > 8) return plane;
  // 5 to 8 are stored by columns; of each four, these begin at the right and these at the bottom.
  const bool byColumns = orientation > 4;
  const bool fromRight =
      orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool fromBottom =
      orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  int width = plane.width(), height = plane.height();
  if (byColumns) std::swap(width, height);
  Floats upright(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int u = fromRight ? width - 1 - x : x, v = fromBottom ? height - 1 - y : y;
      upright(x, y) = byColumns ? plane(v, u) : plane(u, v);
    }
  return upright;
}

}  // namespace kagefude
