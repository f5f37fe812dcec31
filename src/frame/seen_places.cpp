#include "frame/seen_places.h"

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

// Every so many pixels both ways, so that there are about 4,000.
int strideFor(int width, int height) {
  constexpr double places = 4096;
  return std::max(1, static_cast<int>(std::sqrt(static_cast<double>(width) * height / places)));
}

// Whether three positions in a row lie at even steps: no edge, no crease between them.
bool isEven(const V3f& before, const V3f& here, const V3f& after) {
  return (after - here * 2.0f + before).length() < 0.2f * (after - before).length();
}

}  // namespace

std::vector<SeenPoint> seenPoints(const ImageFile& file, Vec3View position) {
  const int stride = strideFor(position.width(), position.height());
  std::vector<SeenPoint> points;
  for (int y = stride / 2; y < position.height(); y += stride)
    for (int x = stride / 2; x < position.width(); x += stride) {
      const V3f p = position(x, y);
      if (p == V3f(0.0f) || !std::isfinite(p.x + p.y + p.z)) continue;
      points.push_back(
          {V3d(p), (file.dataWindow.x + x + 0.5) * file.pixelAspect, file.dataWindow.y + y + 0.5});
    }
  return points;
}

std::vector<SmoothPlace> smoothPlaces(Vec3View position, Vec3View normal,
                                      View<const uint32_t> ids) {
  const int width = position.width(), height = position.height();
  const int stride = strideFor(width, height);
  std::vector<SmoothPlace> places;
  for (int y = std::max(1, stride / 2); y < height - 1; y += stride)
    for (int x = std::max(1, stride / 2); x < width - 1; x += stride) {
      const uint32_t id = ids(x, y);
      if (id == 0 || ids(x - 1, y) != id || ids(x + 1, y) != id || ids(x, y - 1) != id ||
          ids(x, y + 1) != id)
        continue;
      const V3f here = position(x, y);
      const V3f left = position(x - 1, y), right = position(x + 1, y);
      const V3f above = position(x, y - 1), below = position(x, y + 1);
      if (!isEven(left, here, right) || !isEven(above, here, below)) continue;
      // Rows run down, so this order points at the viewer in a right-handed space.
      const V3f spanned = (below - above).cross(right - left);
      const V3f given = normal(x, y);
      if (!(spanned.length2() > 0) || !(given.length2() > 0)) continue;
      places.push_back({given, spanned.normalized(), x, y});
    }
  return places;
}

}  // namespace kagefude
