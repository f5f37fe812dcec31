#include "passes/depth_pyramid.h"

#include <algorithm>
#include <limits>

#include "image/parallel.h"

namespace kagefude {

DepthPyramid::DepthPyramid(View<const float> depth) : depth_(depth) {
  int width = depth.width, height = depth.height;
  while (width > 1 || height > 1) {
    const int below = static_cast<int>(nearest_.size());
    const int lastX = width - 1, lastY = height - 1;
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    Floats nearest(width, height), farthest(width, height);
    parallelRows(height, [&](int y0, int y1) {
      for (int y = y0; y < y1; ++y)
        for (int x = 0; x < width; ++x) {
          DepthRange all = at(below, 2 * x, 2 * y);
          for (int i = 1; i < 4; ++i) {
            const DepthRange part =
                at(below, std::min(2 * x + (i & 1), lastX), std::min(2 * y + (i >> 1), lastY));
            all = {std::min(all.nearest, part.nearest), std::max(all.farthest, part.farthest)};
          }
          nearest(x, y) = all.nearest;
          farthest(x, y) = all.farthest;
        }
    });
    nearest_.push_back(std::move(nearest));
    farthest_.push_back(std::move(farthest));
  }
}

DepthRange DepthPyramid::at(int level, int x, int y) const {
  if (level > 0) {
    const size_t i = static_cast<size_t>(level) - 1;
    return {nearest_[i](x, y), farthest_[i](x, y)};
  }
  const float d = depth_(x, y);
  const float known = d == d ? d : std::numeric_limits<float>::infinity();
  return {known, known};
}

DepthRange DepthPyramid::range(int x0, int y0, int x1, int y1) const {
  x0 = std::clamp(x0, 0, depth_.width - 1);
  x1 = std::clamp(x1, 0, depth_.width - 1);
  y0 = std::clamp(y0, 0, depth_.height - 1);
  y1 = std::clamp(y1, 0, depth_.height - 1);
  int level = 0;
  // At this level the rectangle touches at most two texels in each direction.
  while (std::max(x1 - x0, y1 - y0) > (1 << level)) ++level;
  level = std::min(level, static_cast<int>(nearest_.size()));
  DepthRange all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (int y = y0 >> level; y <= y1 >> level; ++y)
    for (int x = x0 >> level; x <= x1 >> level; ++x) {
      const DepthRange part = at(level, x, y);
      all = {std::min(all.nearest, part.nearest), std::max(all.farthest, part.farthest)};
    }
  return all;
}

}  // namespace kagefude
