#include "passes/casters/surface_sampler.h"

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

/// How far apart two surfaces must lie along a ray for their order to count, relative to distance.
constexpr float nearRelative = 2e-5f;

}  // namespace

bool SurfaceSampler::onOneTriangle(const std::array<SightRay, 4>& corners,
                                   std::array<V3f, 4>& found) const {
  const int own = seen_.own();
  if (!seen_.coversPixel(own)) return false;
  float farthest = 0;
  for (int k = 0; k < 4; ++k) {
    const float t = seen_.distance(own, corners[k]);
    if (!(t > 0 && t < farAway)) return false;
    found[k] = lifted(corners[k].origin + corners[k].direction * t, own);
    farthest = std::max(farthest, t);
  }
  return std::all_of(seen_.candidates().begin(), seen_.candidates().end(),
                     [&](int i) { return i == own || seen_.liesBehind(i, corners, farthest); });
}

bool SurfaceSampler::locate(int x, int y, float lift, FlatPixel& flat) {
  x_ = x;
  y_ = y;
  lift_ = lift;
  seen_.find(x, y);
  const std::array<SightRay, 4> corners = {seen_.ray(x, y), seen_.ray(x + 1, y),
                                           seen_.ray(x + 1, y + 1), seen_.ray(x, y + 1)};
  if (seen_.own() >= 0) {
    flat.id = seen_.id(seen_.own());
    flat.facesAway = seen_.facesAway(seen_.own());
    return onOneTriangle(corners, flat.corners);
  }
  flat.id = surface_.ids(x, y);
  flat.facesAway = false;
  for (int k = 0; k < 4; ++k) flat.corners[k] = onPlane(x, y, corners[k]);
  return seen_.candidates().empty();
}

V3f SurfaceSampler::lifted(const V3f& point, int candidate) const {
  return point - seen_.normal(candidate) * lift_;
}

V3f SurfaceSampler::onPlane(int x, int y, const SightRay& ray) const {
  const V3f p = surface_.relative(x, y), n = surface_.normal(x, y);
  const float own = (p - ray.origin).dot(ray.direction) / ray.direction.length2();
  const float t = (p - ray.origin).dot(n) / ray.direction.dot(n);
  // Seen edge-on, or without a normal, the plane says nothing: keep the distance of P.
  if (!(std::fabs(t - own) <= 0.25f * std::fabs(own)))
    return ray.origin + ray.direction * own - ray.direction.normalized() * lift_;
  return ray.origin + ray.direction * t + n * (n.dot(ray.direction) > 0 ? -lift_ : lift_);
}

bool SurfaceSampler::beyondSilhouette(int k, int& column, int& row) const {
  const int right = k % 8 < 4 ? -1 : 1, down = k / 8 < 4 ? -1 : 1;
  const bool wide = std::abs(2 * (k % 8) - 7) >= std::abs(2 * (k / 8) - 7);
  const int steps[8][2] = {{wide ? right : 0, wide ? 0 : down},
                           {wide ? 0 : right, wide ? down : 0},
                           {right, down},
                           {wide ? 0 : -right, wide ? -down : 0},
                           {wide ? right : -right, wide ? -down : down},
                           {wide ? -right : right, wide ? down : -down},
                           {wide ? -right : 0, wide ? 0 : -down},
                           {-right, -down}};
  for (const auto& step : steps) {
    column = x_ + step[0];
    row = y_ + step[1];
    if (surface_.ids.contains(column, row) && !sight_.casters().holds(surface_.ids(column, row)))
      return true;
  }
  return false;
}

bool SurfaceSampler::seenAround(uint32_t id) const {
  for (int row = y_ - 1; row <= y_ + 1; ++row)
    for (int column = x_ - 1; column <= x_ + 1; ++column)
      if (surface_.ids.contains(column, row) && surface_.ids(column, row) == id) return true;
  return false;
}

SurfaceSampler::Shown SurfaceSampler::shown(int k, const SightRay& ray, uint32_t hitId,
                                            const V3f& hit, V3f& plane, int& column,
                                            int& row) const {
  const bool explained = seen_.own() >= 0;
  if (explained && hitId != 0) return Shown::triangle;
  column = x_;
  row = y_;
  if (explained && (!beyondSilhouette(k, column, row) || !surface_.isSurface(column, row)))
    return Shown::background;
  plane = onPlane(column, row, ray);
  const bool before = (plane - hit).dot(ray.direction) > nearRelative * plane.length();
  return hitId != 0 && before && seenAround(hitId) ? Shown::triangle : Shown::pixel;
}

void SurfaceSampler::sample(SubpixelPoints& points) {
  const SubpixelRays rays(surface_.rays, x_, y_);
  SubpixelHits hits;
  for (int i : seen_.candidates()) hits.meet(rays, surface_.rays.orthographic, seen_.wedge(i), i);
  points.present = points.facingAway = 0;
  for (int k = 0; k < 64; ++k) {
    const SightRay ray = rays[k];
    const int triangle = hits.index[k];
    V3f point = ray.origin + ray.direction * hits.t[k], plane;
    if (triangle >= 0) point = lifted(point, triangle);
    points.id[k] = triangle < 0 ? 0 : seen_.id(triangle);
    int column, row;
    switch (shown(k, ray, points.id[k], point, plane, column, row)) {
      case Shown::triangle:
        if (seen_.facesAway(triangle)) points.facingAway |= uint64_t{1} << k;
        break;
      case Shown::pixel:
        point = plane;
        points.id[k] = surface_.ids(column, row);
        break;
      case Shown::background:
        points.place(k, V3f(farAway));
        continue;
    }
    points.present |= uint64_t{1} << k;
    points.place(k, point);
  }
}

}  // namespace kagefude
