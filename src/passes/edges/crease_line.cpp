#include "passes/edges/crease_line.h"

#include <cmath>

namespace kagefude {
namespace {

// A plane's inverse depth (its depth under a parallel projection) round a pixel's centre.
HalfPlane depthOf(const SurfacePoint& surface, const CameraRays& rays, const V3d& centre) {
  const double height = surface.normal.dot(surface.position);
  if (rays.orthographic) {
    const double facing = surface.normal.dot(rays.direction0);
    return {(height - surface.normal.dot(centre)) / facing,
            -surface.normal.dot(rays.originX) / facing, -surface.normal.dot(rays.originY) / facing};
  }
  return {surface.normal.dot(centre) / height, surface.normal.dot(rays.directionX) / height,
          surface.normal.dot(rays.directionY) / height};
}

}  // namespace

std::optional<HalfPlane> creaseLine(const SurfacePoint& own, const SurfacePoint& other,
                                    const CameraRays& rays, int x, int y, int stepX, int stepY) {
  const V3d centre =
      rays.orthographic ? rays.origin(x + 0.5, y + 0.5) : rays.direction(x + 0.5, y + 0.5);
  const HalfPlane a = depthOf(own, rays, centre), b = depthOf(other, rays, centre);
  HalfPlane apart{b.constant - a.constant, b.x - a.x, b.y - a.y};
  const double here = apart.constant, there = apart.at(stepX, stepY);
  if (!std::isfinite(here) || !std::isfinite(there) || !(here * there < 0)) return {};
  if (here > 0) apart = {-apart.constant, -apart.x, -apart.y};
  return apart;
}

}  // namespace kagefude
