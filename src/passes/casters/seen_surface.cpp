#include "passes/casters/seen_surface.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"

namespace kagefude {

bool SeenSurface::isSurface(int x, int y) const {
  return ids(x, y) != 0 && std::isfinite(position.x(x, y)) && std::isfinite(position.y(x, y)) &&
         std::isfinite(position.z(x, y));
}

float SeenSurface::pixelSize(int x, int y) const {
  if (rays.orthographic) return static_cast<float>(rays.pixelSize(0));
  const V3d d = rays.direction(x + 0.5, y + 0.5);
  return static_cast<float>(rays.pixelSize(V3d(relative(x, y)).dot(d) / d.length2()));
}

void SeenSurface::check() const {
  const auto same = [&](const View<const float>& v) {
    return v.width == ids.width && v.height == ids.height;
  };
  if (!same(position.x) || !same(position.y) || !same(position.z) || !same(normal.x) ||
      !same(normal.y) || !same(normal.z))
    throw InputError(fmt::format("position ({}x{}), normal ({}x{}) and id ({}x{}) differ in size",
                                 position.width(), position.height(), normal.width(),
                                 normal.height(), ids.width, ids.height));
}

}  // namespace kagefude
