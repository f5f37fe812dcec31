#include "passes/edges/crease_line.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kagefude {
namespace {

// A camera at the origin that looks along -z, 100 pixels wide; a point's pixel is exact.
CameraRays perspectiveRays() {
  CameraRays rays;
  rays.direction0 = {-0.5, 0.5, -1};
  rays.directionX = {0.01, 0, 0};
  rays.directionY = {0, -0.01, 0};
  return rays;
}
CameraRays parallelRays() {
  CameraRays rays;
  rays.orthographic = true;
  rays.origin0 = {-0.5, 0.5, 0};
  rays.originX = {0.01, 0, 0};
  rays.originY = {0, -0.01, 0};
  rays.direction0 = {0, 0, -1};
  return rays;
}

/// Where the ray through a pixel's centre meets a plane.
V3d hit(const CameraRays& rays, double x, double y, const V3d& onPlane, const V3d& normal) {
  const V3d from = rays.origin(x + 0.5, y + 0.5), way = rays.direction(x + 0.5, y + 0.5);
  return from + way * (normal.dot(onPlane - from) / normal.dot(way));
}

// Two walls that meet in a slanted line; the line's place is computed from the walls' meeting
// points.
void expectCrease(const CameraRays& rays, const V3d& left, const V3d& right) {
  const double scale = rays.orthographic ? 1 : 1 / 3.0;
  const V3d edge(0.0031, 0.005 / scale, -3);                  // in the middle of row 49
  const double column = (edge.x * scale + 0.5) / 0.01 - 0.5;  // where the crease crosses the row
  const int x = static_cast<int>(std::floor(column)), y = 49;
  const SurfacePoint own{hit(rays, x, y, edge, left), left};
  const SurfacePoint other{hit(rays, x + 1, y, edge, right), right};
  const auto line = creaseLine(own, other, rays, x, y, 1, 0);
  ASSERT_TRUE(line);
  EXPECT_LT(line->at(0, 0), 0);
  EXPECT_GT(line->at(1, 0), 0);
  // The crease itself: along the cross product of the normals.
  const V3d along = left.cross(right).normalized();
  for (const double t : {-0.01, 0.0, 0.01}) {
    const V3d p = edge + along * t;
    const double depth = rays.orthographic ? 1 : -p.z;
    const double px = (p.x / depth + 0.5) / 0.01 - 0.5, py = (0.5 - p.y / depth) / 0.01 - 0.5;
    EXPECT_NEAR(line->at(px - x, py - y) / std::hypot(line->x, line->y), 0, 1e-9);
  }
}

TEST(CreaseLine, ConvexAndHollowInBothProjections) {
  for (const CameraRays& rays : {perspectiveRays(), parallelRays()}) {
    expectCrease(rays, V3d(-1, 0.2, 1), V3d(1, 0.1, 0.8));
    expectCrease(rays, V3d(1, 0.2, 1), V3d(-1, 0.1, 0.8));
    expectCrease(rays, V3d(1, -0.2, -1), V3d(-1, 0.3, 0.5));
  }
}

TEST(CreaseLine, NothingWhereOneSurfaceHidesTheOther) {
  const CameraRays rays = perspectiveRays();
  const V3d facing(0, 0, 1);
  const SurfacePoint near{hit(rays, 50, 49, {0, 0, -2}, facing), facing};
  const SurfacePoint far{hit(rays, 51, 49, {0, 0, -3}, facing), facing};
  EXPECT_FALSE(creaseLine(near, far, rays, 50, 49, 1, 0));
  EXPECT_FALSE(creaseLine(far, near, rays, 51, 49, -1, 0));
}

TEST(CreaseLine, NothingOfSurfacesEdgeOnOrNotFinite) {
  const CameraRays rays = perspectiveRays();
  const SurfacePoint good{{0, 0, -2}, {0, 0, 1}};
  EXPECT_FALSE(creaseLine(good, {{0.02, 0, -2}, {0, 0, 0}}, rays, 49, 49, 1, 0));
  EXPECT_FALSE(creaseLine(good, {{std::nan(""), 0, -2}, {0, 0, 1}}, rays, 49, 49, 1, 0));
}

}  // namespace
}  // namespace kagefude
