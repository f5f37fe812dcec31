#include "passes/depth_map/depth_pyramid.h"

#include <algorithm>
#include <limits>

#include "image/parallel.h"

namespace kagefude {
namespace {

float nearestOf(float a, float b) { return b < a ? b : a; }
float farthestOf(float a, float b) { return b > a ? b : a; }

/// Halves a plane by a choice among each two by two; the last column and row may stand alone.
/// NaN becomes infinity.
template <class Choice>
Floats halved(View<const float> from, const Choice& choice) {
  Floats to((from.width + 1) / 2, (from.height + 1) / 2);
  const auto known = [](float d) { return d == d ? d : std::numeric_limits<float>::infinity(); };
  parallelRows(to.height(), [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y) {
      const float* const upper = from.row(2 * y);
      const float* const lower = from.row(std::min(2 * y + 1, from.height - 1));
      float* const out = to.row(y);
      const int pairs = from.width / 2;
      for (int x = 0; x < pairs; ++x)
        out[x] = choice(choice(known(upper[2 * x]), known(upper[2 * x + 1])),
                        choice(known(lower[2 * x]), known(lower[2 * x + 1])));
      if (from.width % 2) out[pairs] = choice(known(upper[2 * pairs]), known(lower[2 * pairs]));
    }
  });
  return to;
}

}  // namespace

DepthPyramid::DepthPyramid(View<const float> depth) {
  View<const float> nearest = depth, farthest = depth;
  do {
    nearest = nearest_.emplace_back(halved(nearest, nearestOf));
    farthest = farthest_.emplace_back(halved(farthest, farthestOf));
  } while (nearest.width > 1 || nearest.height > 1);
}

DepthRange DepthPyramid::whole() const { return {nearest_.back()(0, 0), farthest_.back()(0, 0)}; }

DepthPyramid::Level DepthPyramid::levelFor(int texels) const {
  size_t level = 1;
  while (level < nearest_.size() && (1 << level) < texels - 1) ++level;
  return {nearest_[level - 1], farthest_[level - 1], static_cast<int>(level)};
}

}  // namespace kagefude
