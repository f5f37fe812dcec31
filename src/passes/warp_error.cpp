#include "passes/warp_error.h"

#include <cmath>
#include <vector>

#include "image/parallel.h"

namespace kagefude {
namespace {

/// Where a pixel's surface was in the previous frame, as bilinear weights.
struct Place {
  int x = 0, y = 0;
  float fx = 0, fy = 0;

  float read(View<const float> plane) const {
    const int right = fx > 0.0f ? x + 1 : x, below = fy > 0.0f ? y + 1 : y;
    const float top = plane(x, y) + (plane(right, y) - plane(x, y)) * fx;
    const float bottom = plane(x, below) + (plane(right, below) - plane(x, below)) * fx;
    return top + (bottom - top) * fy;
  }
};

bool findPlace(View<const uint32_t> previousIds, uint32_t id, float px, float py, Place& place) {
  if (!(px >= 0.0f && py >= 0.0f && px <= static_cast<float>(previousIds.width - 1) &&
        py <= static_cast<float>(previousIds.height - 1)))
    return false;
  place.x = static_cast<int>(px);
  place.y = static_cast<int>(py);
  place.fx = px - static_cast<float>(place.x);
  place.fy = py - static_cast<float>(place.y);
  for (int dy = 0; dy <= (place.fy > 0.0f); ++dy)
    for (int dx = 0; dx <= (place.fx > 0.0f); ++dx)
      if (previousIds(place.x + dx, place.y + dy) != id) return false;
  return true;
}

}  // namespace

WarpError warpError(std::span<const View<const float>> current,
                    std::span<const View<const float>> previous, View<const uint32_t> currentIds,
                    View<const uint32_t> previousIds, View<const float> motionX,
                    View<const float> motionY) {
  const int width = currentIds.width, height = currentIds.height;
  WarpError result;
  result.perPixel = Floats(width, height, -1.0f);
  std::vector<double> rowSums(static_cast<size_t>(height));
  std::vector<int64_t> rowPixels(static_cast<size_t>(height));
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        Place place;
        const float px = static_cast<float>(x) + motionX(x, y);
        const float py = static_cast<float>(y) - motionY(x, y);
        if (currentIds(x, y) == 0 || !findPlace(previousIds, currentIds(x, y), px, py, place))
          continue;
        double squares = 0;
        for (size_t c = 0; c < current.size(); ++c) {
          const double d = double(current[c](x, y)) - double(place.read(previous[c]));
          squares += d * d;
        }
        squares /= static_cast<double>(current.size());
        if (!std::isfinite(squares)) continue;
        result.perPixel(x, y) = static_cast<float>(std::sqrt(squares));
        rowSums[static_cast<size_t>(y)] += squares;
        ++rowPixels[static_cast<size_t>(y)];
      }
  });
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    sum += rowSums[static_cast<size_t>(y)];
    result.pixels += rowPixels[static_cast<size_t>(y)];
  }
  if (result.pixels > 0) result.rmse = std::sqrt(sum / static_cast<double>(result.pixels));
  return result;
}

}  // namespace kagefude
