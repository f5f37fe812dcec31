#include "passes/pixel_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kagefude {
namespace {

V3f absolute(const V3f& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

V3f larger(const V3f& a, const V3f& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

V3f smaller(const V3f& a, const V3f& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

/// Largest step from P to its neighbours of the same object along x or along y. Without such a
/// neighbour a slope of the surface is allowed for that makes it ten times the pixel's size.
V3f stepAlong(const SeenSurface& surface, int x, int y, int dx, int dy, float pixel) {
  const V3f p = surface.relative(x, y);
  V3f step(0.0f);
  bool found = false;
  for (int side = -1; side <= 1; side += 2) {
    const int column = x + side * dx, row = y + side * dy;
    if (!surface.ids.contains(column, row) || surface.ids(column, row) != surface.ids(x, y) ||
        !surface.isSurface(column, row))
      continue;
    step = larger(step, absolute(surface.relative(column, row) - p));
    found = true;
  }
  return found ? step : V3f(10 * pixel);
}

}  // namespace

PixelBoxes::PixelBoxes(const SeenSurface& surface, int x0, int y0, bool centres)
    : width_(std::min(coverageTile, surface.ids.width - x0)),
      height_(std::min(coverageTile, surface.ids.height - y0)) {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      Extent& extent = pixels_[y * coverageTile + x];
      extent.present = surface.isSurface(x0 + x, y0 + y);
      if (extent.present) measure(surface, x0 + x, y0 + y, centres, extent);
    }
}

void PixelBoxes::measure(const SeenSurface& surface, int x, int y, bool centres, Extent& extent) {
  const V3f p = surface.relative(x, y);
  const float pixel = surface.pixelSize(x, y);
  pixelSize_ = std::max(pixelSize_, pixel);
  reach_ = std::max(reach_, p.length());
  extent.low = extent.high = p;
  if (centres) return;
  const V3f half =
      (stepAlong(surface, x, y, 1, 0, pixel) + stepAlong(surface, x, y, 0, 1, pixel)) * 0.55f +
      V3f(0.1f * pixel);
  extent.low -= half;
  extent.high += half;
  for (int row = y - 1; row <= y + 1; ++row)
    for (int column = x - 1; column <= x + 1; ++column) {
      if (!surface.ids.contains(column, row) || surface.ids(column, row) == surface.ids(x, y) ||
          !surface.isSurface(column, row))
        continue;
      const V3f other = surface.relative(column, row);
      const V3f around = larger(half, V3f(3 * surface.pixelSize(column, row)));
      extent.low = smaller(extent.low, other - around);
      extent.high = larger(extent.high, other + around);
    }
}

bool PixelBoxes::around(int x0, int y0, int x1, int y1, PointBox& box) const {
  V3f low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  bool found = false;
  for (int y = y0; y < std::min(y1, height_); ++y)
    for (int x = x0; x < std::min(x1, width_); ++x) {
      const Extent& extent = pixels_[y * coverageTile + x];
      if (!extent.present) continue;
      low = smaller(low, extent.low);
      high = larger(high, extent.high);
      found = true;
    }
  if (found) box = PointBox::around(low, high);
  return found;
}

}  // namespace kagefude
