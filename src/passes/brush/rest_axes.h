#pragma once

#include <cmath>

#include "image/real_math.h"

namespace kagefude {

/// Of one pixel: the changes of the surface's position in the world to the next pixel across and
/// down, (dx, dy, dz) and (ex, ey, ez), and those of its place at rest to the same neighbours along
/// the three axes.
struct RestChange {
  float dx, dy, dz, ex, ey, ez;
  float across[3], down[3];
};

/// Below this, the squared sine between two changes is lost in rounding.
inline constexpr float leastSlant = 1e-6f;

/// **[ours]** Octaves by which the surface is larger than at rest, each way on average: half the
/// base-2 logarithm of its area's ratio, within 4 of 0; 0 where either pair spans no plane.
inline float restStretch(const RestChange& c) {
  const float* const p = c.across;
  const float* const q = c.down;
  const float nx = c.dy * c.ez - c.dz * c.ey, ny = c.dz * c.ex - c.dx * c.ez,
              nz = c.dx * c.ey - c.dy * c.ex;
  const float rx = p[1] * q[2] - p[2] * q[1], ry = p[2] * q[0] - p[0] * q[2],
              rz = p[0] * q[1] - p[1] * q[0];
  const float seen = nx * nx + ny * ny + nz * nz, rest = rx * rx + ry * ry + rz * rz;
  if (!(seen > 0.0f) || !(rest > 0.0f)) return 0.0f;
  const float octaves = 0.25f * (log2Of(seen) - log2Of(rest));
  return octaves > -4.0f ? (octaves < 4.0f ? octaves : 4.0f) : -4.0f;
}

/// **[ours]** What directions of the deformed surface are along the axes of its rest: a direction d
/// of the world has the part x[k] d.x + y[k] d.y + z[k] d.z along axis k. The map carries both
/// changes to theirs at rest, and the unit normal of the one pair to that of the other, so a thing
/// that only turned gets its exact rotation back at any pixel, creases included. False (and nothing
/// is set) where the pair spans no plane: seen edge-on, or without a neighbour.
inline bool restAxes(const RestChange& c, float* x, float* y, float* z) {
  const float* const p = c.across;
  const float* const q = c.down;
  const float nx = c.dy * c.ez - c.dz * c.ey, ny = c.dz * c.ex - c.dx * c.ez,
              nz = c.dx * c.ey - c.dy * c.ex;
  const float restNormal[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                               p[0] * q[1] - p[1] * q[0]};
  const float d2 = c.dx * c.dx + c.dy * c.dy + c.dz * c.dz,
              e2 = c.ex * c.ex + c.ey * c.ey + c.ez * c.ez;
  const float n2 = nx * nx + ny * ny + nz * nz;
  const float p2 = p[0] * p[0] + p[1] * p[1] + p[2] * p[2],
              q2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
  const float r2 =
      restNormal[0] * restNormal[0] + restNormal[1] * restNormal[1] + restNormal[2] * restNormal[2];
  const bool spans = (n2 > leastSlant * (d2 * e2)) & (r2 > leastSlant * (p2 * q2));
  // The pair's dual basis: its products with the pair are 1 and 0, with the normal 0.
  const float inverse = spans ? 1.0f / n2 : 0.0f;
  const float ax = (c.ey * nz - c.ez * ny) * inverse, ay = (c.ez * nx - c.ex * nz) * inverse,
              az = (c.ex * ny - c.ey * nx) * inverse;
  const float bx = (ny * c.dz - nz * c.dy) * inverse, by = (nz * c.dx - nx * c.dz) * inverse,
              bz = (nx * c.dy - ny * c.dx) * inverse;
  const float normals = spans ? 1.0f / std::sqrt(n2 * r2) : 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float across = p[k], down = q[k], normal = restNormal[k] * normals;
    x[k] = spans ? across * ax + down * bx + normal * nx : x[k];
    y[k] = spans ? across * ay + down * by + normal * ny : y[k];
    z[k] = spans ? across * az + down * bz + normal * nz : z[k];
  }
  return spans;
}

}  // namespace kagefude
