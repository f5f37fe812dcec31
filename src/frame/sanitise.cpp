#include "frame/sanitise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "image/parallel.h"

namespace kagefude {
namespace {

bool finiteAt(const Vec3Plane& planes, int x, int y) {
  return std::isfinite(planes.x(x, y)) && std::isfinite(planes.y(x, y)) &&
         std::isfinite(planes.z(x, y));
}

// NaN of either sign, or -Inf: what lies above Inf of its sign, and -Inf itself.
bool isNoDepth(float texel) {
  const auto bits = std::bit_cast<int32_t>(texel);
  return (bits > 0x7f800000) | ((bits < 0) & (bits >= -0x00800000));
}

// Counts are kept by row and summed in order, so nothing is shared between threads.
template <class CountRow>
size_t countRows(int rows, const CountRow& countRow) {
  std::vector<size_t> counts(static_cast<size_t>(rows), 0);
  parallelRows(rows, [&](int first, int end) {
    for (int y = first; y < end; ++y) counts[static_cast<size_t>(y)] = countRow(y);
  });
  return std::accumulate(counts.begin(), counts.end(), size_t{0});
}

}  // namespace

size_t clearNonFinite(Vec3Plane& position, Vec3Plane& normal, View<uint32_t> labels) {
  const Vec3Plane& given = position.empty() ? normal : position;
  if (given.empty()) return 0;
  return countRows(given.x.height(), [&](int y) {
    size_t count = 0;
    for (int x = 0; x < given.x.width(); ++x) {
      const bool good = (position.empty() || finiteAt(position, x, y)) &&
                        (normal.empty() || finiteAt(normal, x, y));
      if (good) continue;
      if (!position.empty()) position.set(x, y, V3f(0, 0, 0));
      if (!normal.empty()) normal.set(x, y, V3f(0, 0, 0));
      if (!labels.empty()) labels(x, y) = 0;
      ++count;
    }
    return count;
  });
}

size_t clearNonFiniteColour(Vec3Plane& colour, View<float> alpha) {
  if (colour.empty()) return clearNonFinite(alpha, 0.0f);
  return countRows(colour.x.height(), [&](int y) {
    size_t count = 0;
    for (int x = 0; x < colour.x.width(); ++x) {
      const bool goodAlpha = alpha.empty() || std::isfinite(alpha(x, y));
      if (finiteAt(colour, x, y) && goodAlpha) continue;
      colour.set(x, y, V3f(0, 0, 0));
      if (!goodAlpha) alpha(x, y) = 0;
      ++count;
    }
    return count;
  });
}

size_t clearNoDepth(View<float> depth) {
  return countRows(depth.height, [&](int y) {
    float* const row = depth.row(y);
    int count = 0;  // alone in its loop, of whole numbers, which then vectorises
    for (int x = 0; x < depth.width; ++x) count += isNoDepth(row[x]);
    if (count > 0) std::replace_if(row, row + depth.width, isNoDepth, 1e10f);
    return static_cast<size_t>(count);
  });
}

size_t clearNonFinite(View<float> plane, float background) {
  if (plane.empty()) return 0;
  return countRows(plane.height, [&](int y) {
    size_t count = 0;
    for (int x = 0; x < plane.width; ++x) {
      if (std::isfinite(plane(x, y))) continue;
      plane(x, y) = background;
      ++count;
    }
    return count;
  });
}

}  // namespace kagefude
