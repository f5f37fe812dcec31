#include "passes/measure/warp_error.h"

#include <cmath>
#include <limits>
#include <vector>

#include "image/parallel.h"

namespace kagefude {
namespace {

/// A place between pixel centres as weights of 4 x 4 or 2 x 2 pixels.
struct Reader {
  int x = 0, y = 0, count = 2;  ///< first pixel, and how many each way
  float across[4], down[4];

  Reader(float px, float py, bool smooth) {
    x = static_cast<int>(px);
    y = static_cast<int>(py);
    const float fx = px - static_cast<float>(x), fy = py - static_cast<float>(y);
    if (!smooth) {
      across[0] = 1.0f - fx, across[1] = fx;
      down[0] = 1.0f - fy, down[1] = fy;
      return;
    }
    count = 4;
    --x;
    --y;
    cubic(fx, across);
    cubic(fy, down);
  }

  // Pixels of weight 0 are not touched: they may lie outside.
  float read(View<const float> plane) const {
    float sum = 0;
    for (int j = 0; j < count; ++j) {
      if (down[j] == 0.0f) continue;
      float row = 0;
      for (int i = 0; i < count; ++i)
        if (across[i] != 0.0f) row += across[i] * plane(x + i, y + j);
      sum += down[j] * row;
    }
    return sum;
  }

 private:
  static void cubic(float t, float* weights) {
    weights[0] = t * (-0.5f + t * (1.0f - 0.5f * t));
    weights[1] = 1.0f + t * t * (-2.5f + 1.5f * t);
    weights[2] = t * (0.5f + t * (2.0f - 1.5f * t));
    weights[3] = t * t * (-0.5f + 0.5f * t);
  }
};

bool allOf(View<const uint32_t> ids, int x0, int y0, int x1, int y1, uint32_t id) {
  if (x0 < 0 || y0 < 0 || x1 >= ids.width || y1 >= ids.height) return false;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (ids(x, y) != id) return false;
  return true;
}

float distance(const V3f& a, const V3f& b) { return (a - b).length(); }

// Longer of the steps to the next pixel across and down, each to its nearer neighbour.
float stepAt(Vec3View position, int x, int y) {
  const V3f p = position(x, y);
  const float across = std::min(distance(position(x - 1, y), p), distance(position(x + 1, y), p));
  const float down = std::min(distance(position(x, y - 1), p), distance(position(x, y + 1), p));
  return std::max(across, down);
}

class PlaceFinder {
 public:
  explicit PlaceFinder(const MotionInput& in) : in_(in) {}

  // Whether pixel (x, y) is compared; then where, and whether smoothly.
  bool find(int x, int y, float& px, float& py, bool& smooth) const {
    const uint32_t id = in_.ids(x, y);
    px = static_cast<float>(x) + in_.motionX(x, y);
    py = static_cast<float>(y) - in_.motionY(x, y);
    if (id == 0 || !allOf(in_.ids, x - 1, y - 1, x + 1, y + 1, id)) return false;
    if (!(px >= 0.0f && py >= 0.0f && px <= static_cast<float>(in_.ids.width - 1) &&
          py <= static_cast<float>(in_.ids.height - 1)))
      return false;
    const int left = static_cast<int>(px), top = static_cast<int>(py);
    const int right = px > static_cast<float>(left) ? left + 1 : left;
    const int bottom = py > static_cast<float>(top) ? top + 1 : top;
    if (!allOf(in_.previousIds, left, top, right, bottom, id)) return false;
    smooth = allOf(in_.previousIds, left - 1, top - 1, left + 2, top + 2, id);
    if (in_.expected.empty()) return true;
    const float reach = 1.5f * stepAt(in_.position, x, y);
    smooth = smooth && miss(x, y, Reader(px, py, true)) <= reach;
    return smooth || miss(x, y, Reader(px, py, false)) <= reach;
  }

 private:
  float miss(int x, int y, const Reader& reader) const {
    return distance(in_.expected(x, y),
                    {reader.read(in_.previousPosition.x), reader.read(in_.previousPosition.y),
                     reader.read(in_.previousPosition.z)});
  }

  const MotionInput& in_;
};

template <class Number>
Number sumOf(const std::vector<Number>& rows) {
  Number sum = 0;
  for (const Number row : rows) sum += row;
  return sum;
}

}  // namespace

PreviousPlaces findPreviousPlaces(const MotionInput& in) {
  const int width = in.ids.width, height = in.ids.height;
  PreviousPlaces places{Floats(width, height), Floats(width, height), Bytes(width, height), 0};
  std::vector<int64_t> rowPixels(static_cast<size_t>(height));
  const PlaceFinder finder(in);
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        float px, py;
        bool smooth = false;
        const bool found = finder.find(x, y, px, py, smooth);
        places.x(x, y) = found ? px : std::numeric_limits<float>::quiet_NaN();
        places.y(x, y) = found ? py : std::numeric_limits<float>::quiet_NaN();
        places.smooth(x, y) = smooth;
        rowPixels[static_cast<size_t>(y)] += found;
      }
  });
  places.pixels = sumOf(rowPixels);
  return places;
}

WarpError warpError(std::span<const View<const float>> current,
                    std::span<const View<const float>> previous, const PreviousPlaces& places) {
  const int width = places.x.width(), height = places.x.height();
  WarpError result;
  result.perPixel = Floats(width, height, -1.0f);
  std::vector<double> rowSums(static_cast<size_t>(height));
  std::vector<int64_t> rowPixels(static_cast<size_t>(height));
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const float px = places.x(x, y), py = places.y(x, y);
        if (std::isnan(px)) continue;
        const Reader reader(px, py, places.smooth(x, y) != 0);
        double squares = 0;
        for (size_t c = 0; c < current.size(); ++c) {
          const double d = double(current[c](x, y)) - double(reader.read(previous[c]));
          squares += d * d;
        }
        squares /= static_cast<double>(current.size());
        if (!std::isfinite(squares)) continue;
        result.perPixel(x, y) = static_cast<float>(std::sqrt(squares));
        rowSums[static_cast<size_t>(y)] += squares;
        ++rowPixels[static_cast<size_t>(y)];
      }
  });
  result.pixels = sumOf(rowPixels);
  if (result.pixels > 0)
    result.rmse = std::sqrt(sumOf(rowSums) / static_cast<double>(result.pixels));
  return result;
}

}  // namespace kagefude
