#include "passes/casters/pixel_boxes.h"

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

/// Steps along x or y beyond which one side has jumped rather than curved, relative to the other.
constexpr float jump = 3;
/// A box this many times larger than its pixels in a row holds surfaces apart from each other.
constexpr float stretch = 4;

struct Step {
  V3f reach{0, 0, 0};   ///< larger of both sides, by component
  bool broken = false;  ///< another object or a jump on a side, or nothing to measure by
};

Step stepAlong(const SeenSurface& surface, int x, int y, int dx, int dy, float pixel) {
  const V3f p = surface.relative(x, y);
  Step step;
  float length[2] = {-1, -1};
  for (int side = 0; side < 2; ++side) {
    const int column = x + (2 * side - 1) * dx, row = y + (2 * side - 1) * dy;
    if (!surface.ids.contains(column, row) || !surface.isSurface(column, row)) continue;
    if (surface.ids(column, row) != surface.ids(x, y)) {
      step.broken = true;
      continue;
    }
    const V3f way = surface.relative(column, row) - p;
    step.reach = larger(step.reach, absolute(way));
    length[side] = way.length();
  }
  const float least = std::min(length[0], length[1]), most = std::max(length[0], length[1]);
  if (most < 0 || (least >= 0 && most > jump * least + pixel)) step.broken = true;
  return step;
}

bool besideAnotherCorner(const SeenSurface& surface, int x, int y) {
  for (int k = 0; k < 4; ++k) {
    const int column = x + (k % 2 ? 1 : -1), row = y + (k / 2 ? 1 : -1);
    if (surface.ids.contains(column, row) && surface.ids(column, row) != surface.ids(x, y) &&
        surface.isSurface(column, row))
      return true;
  }
  return false;
}

}  // namespace

PixelBoxes::PixelBoxes(const SeenSurface& surface, int x0, int y0, bool centres)
    : width_(std::min(coverageTile, surface.ids.width - x0)),
      height_(std::min(coverageTile, surface.ids.height - y0)) {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (surface.isSurface(x0 + x, y0 + y))
        measure(surface, x0 + x, y0 + y, centres, pixels_[y * coverageTile + x]);
}

void PixelBoxes::measure(const SeenSurface& surface, int x, int y, bool centres, Extent& extent) {
  const V3f p = surface.relative(x, y);
  const float pixel = surface.pixelSize(x, y);
  pixelSize_ = std::max(pixelSize_, pixel);
  reach_ = std::max(reach_, p.length());
  extent.low = extent.high = p;
  const Step across = stepAlong(surface, x, y, 1, 0, pixel);
  const Step down = stepAlong(surface, x, y, 0, 1, pixel);
  const bool broken = across.broken || down.broken || besideAnotherCorner(surface, x, y);
  const V3f half = (across.reach + down.reach) * 0.55f + V3f(0.1f * pixel);
  extent.size = broken ? 2 * pixel : 2 * std::max({half.x, half.y, half.z});
  extent.kind = broken && !centres ? Kind::edge : Kind::smooth;
  if (centres) {
    // Room for lifting points off their surface.
    extent.low -= V3f(0.1f * pixel);
    extent.high += V3f(0.1f * pixel);
    return;
  }
  extent.low -= half;
  extent.high += half;
}

bool PixelBoxes::around(int x0, int y0, int x1, int y1, PointBox& box, bool& stretched) const {
  V3f low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  float size = 0;
  bool found = false;
  for (int y = y0; y < std::min(y1, height_); ++y)
    for (int x = x0; x < std::min(x1, width_); ++x) {
      const Extent& extent = pixels_[y * coverageTile + x];
      if (extent.kind != Kind::smooth) continue;
      low = smaller(low, extent.low);
      high = larger(high, extent.high);
      size = std::max(size, extent.size);
      found = true;
    }
  if (!found) return false;
  box = PointBox::around(low, high);
  const float most = 2 * std::max({box.half.x, box.half.y, box.half.z});
  stretched = most > stretch * size * static_cast<float>(x1 - x0);
  return true;
}

}  // namespace kagefude
