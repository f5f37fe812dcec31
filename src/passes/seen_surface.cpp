#include "passes/seen_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/clones.h"

namespace kagefude {
namespace {

constexpr float farAway = 3e38f;
/// How far P may lie from its triangle: in widths of a pixel, and relative to its distance.
constexpr float nearPixels = 0.05f, nearRelative = 2e-5f;

V3f rayPoint(const V3f& origin, const V3f& direction, float t) { return origin + direction * t; }

/// Wedges whose sides may hold a ray of the pixel: sides are linear in the picture, so the value
/// at the centre and the two half steps bound them.
KAGEFUDE_CLONES void pixelTouches(const float* const* c, int count, const float* centre,
                                  const float* stepX, const float* stepY, uint8_t* touching) {
  for (int i = 0; i < count; ++i) {
    float most = 1e30f;
    for (int plane = 0; plane < 3; ++plane) {
      const float nx = c[4 * plane][i], ny = c[4 * plane + 1][i], nz = c[4 * plane + 2][i];
      const float middle = nx * centre[0] + ny * centre[1] + nz * centre[2] - c[4 * plane + 3][i];
      const float alongX = nx * stepX[0] + ny * stepX[1] + nz * stepX[2];
      const float alongY = nx * stepY[0] + ny * stepY[1] + nz * stepY[2];
      const float high = middle + 0.501f * (std::fabs(alongX) + std::fabs(alongY));
      most = high < most ? high : most;
    }
    touching[i] = most >= 0.0f ? 1 : 0;
  }
}

}  // namespace

struct SurfaceSampler::Rays {
  alignas(64) float ox[64], oy[64], oz[64];
  alignas(64) float dx[64], dy[64], dz[64];
  V3f centre, stepX, stepY;  ///< of direction, or of origin for an orthographic camera
  V3f centreOrigin, centreDirection;
  bool orthographic;

  Rays(const CameraRays& camera, int column, int row) : orthographic(camera.orthographic) {
    for (int k = 0; k < 64; ++k) {
      const double x = column + (k % 8 + 0.5) / 8, y = row + (k / 8 + 0.5) / 8;
      const V3d o = camera.origin(x, y), d = camera.direction(x, y);
      ox[k] = static_cast<float>(o.x);
      oy[k] = static_cast<float>(o.y);
      oz[k] = static_cast<float>(o.z);
      dx[k] = static_cast<float>(d.x);
      dy[k] = static_cast<float>(d.y);
      dz[k] = static_cast<float>(d.z);
    }
    centreOrigin = V3f(camera.origin(column + 0.5, row + 0.5));
    centreDirection = V3f(camera.direction(column + 0.5, row + 0.5));
    centre = orthographic ? centreOrigin : centreDirection;
    stepX = V3f(orthographic ? camera.originX : camera.directionX);
    stepY = V3f(orthographic ? camera.originY : camera.directionY);
  }
  V3f origin(int k) const { return {ox[k], oy[k], oz[k]}; }
  V3f direction(int k) const { return {dx[k], dy[k], dz[k]}; }
};

struct SurfaceSampler::Hits {
  alignas(64) float t[64];
  alignas(64) int index[64];
};

namespace {

/// Takes the triangle where a ray passes its sides and meets it before the best so far.
KAGEFUDE_CLONES void meetTriangle(const float* c, const float* qx, const float* qy, const float* qz,
                                  const float* ox, const float* oy, const float* oz,
                                  const float* dx, const float* dy, const float* dz, int triangle,
                                  float* t, int* index) {
  for (int i = 0; i < 64; ++i) {
    const float s0 = c[0] * qx[i] + c[1] * qy[i] + c[2] * qz[i] - c[3];
    const float s1 = c[4] * qx[i] + c[5] * qy[i] + c[6] * qz[i] - c[7];
    const float s2 = c[8] * qx[i] + c[9] * qy[i] + c[10] * qz[i] - c[11];
    const float distance = c[15] - (c[12] * ox[i] + c[13] * oy[i] + c[14] * oz[i]);
    const float speed = c[12] * dx[i] + c[13] * dy[i] + c[14] * dz[i];
    const float at = speed > 0.0f ? distance / speed : farAway;
    const bool hit = (s0 >= 0.0f) & (s1 >= 0.0f) & (s2 >= 0.0f) & (at > 0.0f) & (at < t[i]);
    t[i] = hit ? at : t[i];
    index[i] = hit ? triangle : index[i];
  }
}

}  // namespace

bool SeenSurface::isSurface(int x, int y) const {
  return ids(x, y) != 0 && std::isfinite(position.x(x, y)) && std::isfinite(position.y(x, y)) &&
         std::isfinite(position.z(x, y));
}

float SeenSurface::pixelSize(int x, int y) const {
  const V3d d = rays.direction(x + 0.5, y + 0.5);
  return static_cast<float>(rays.pixelSize(V3d(relative(x, y)).dot(d) / d.length2()));
}

void SeenSurface::check() const {
  const auto same = [&](const Vec3View& v) {
    return v.x.width == ids.width && v.x.height == ids.height && v.y.width == ids.width &&
           v.y.height == ids.height && v.z.width == ids.width && v.z.height == ids.height;
  };
  if (!same(position) || !same(normal))
    throw InputError(fmt::format("position ({}x{}), normal ({}x{}) and id ({}x{}) differ in size",
                                 position.width(), position.height(), normal.width(),
                                 normal.height(), ids.width, ids.height));
}

PointBox SubpixelPoints::box() const {
  V3f low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (uint64_t rest = present; rest != 0; rest &= rest - 1) {
    const int k = std::countr_zero(rest);
    const V3f p(x[k], y[k], z[k]);
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  return PointBox::around(low, high);
}

void SurfaceSampler::startTile(int x0, int y0, int x1, int y1) {
  x0_ = x0;
  y0_ = y0;
  x1_ = x1;
  y1_ = y1;
  gathered_ = false;
}

bool SurfaceSampler::explain(int x, int y, const Rays& rays) {
  if (!gathered_) {
    const CameraRays& camera = surface_.rays;
    const auto corner = [&](int column, int row) {
      return V3f(camera.orthographic ? camera.origin(column, row) : camera.direction(column, row));
    };
    sight_.gatherSeen({corner(x0_, y0_), corner(x1_, y0_), corner(x1_, y1_), corner(x0_, y1_)},
                      tile_);
    gathered_ = true;
  }
  pixel_.clear();
  hidden_.clear();
  std::vector<uint8_t> touching(static_cast<size_t>(tile_.count + wedgeLanes));
  const float* rows[wedgeCoefficients];
  for (int k = 0; k < wedgeCoefficients; ++k) rows[k] = tile_.coefficients[k].data();
  pixelTouches(rows, tile_.count, &rays.centre.x, &rays.stepX.x, &rays.stepY.x, touching.data());
  const V3f p = surface_.relative(x, y);
  const float tolerance = nearPixels * surface_.pixelSize(x, y) + nearRelative * p.length();
  bool explained = false;
  for (int i = 0; i < tile_.count; ++i) {
    if (!touching[i] || tile_.id[i] == 0) continue;
    pixel_.append(rows, i, tile_.id[i]);
    const std::array<float, wedgeCoefficients> wedge = tile_.wedge(i);
    const float* c = wedge.data();
    bool through = true;
    for (int plane = 0; plane < 3; ++plane, c += 4)
      through &= c[0] * rays.centre.x + c[1] * rays.centre.y + c[2] * rays.centre.z - c[3] >= 0;
    if (!through) continue;
    const float behind = c[0] * p.x + c[1] * p.y + c[2] * p.z - c[3];
    if (std::fabs(behind) <= tolerance)
      explained = true;
    else if (behind > 0)
      hidden_.push_back(tile_.id[i]);
  }
  return explained;
}

void SurfaceSampler::findHits(const Rays& rays, Hits& hits) const {
  std::fill_n(hits.t, 64, farAway);
  std::fill_n(hits.index, 64, -1);
  for (int i = 0; i < pixel_.count; ++i) {
    if (std::find(hidden_.begin(), hidden_.end(), pixel_.id[i]) != hidden_.end()) continue;
    const std::array<float, wedgeCoefficients> wedge = pixel_.wedge(i);
    const bool ortho = rays.orthographic;
    meetTriangle(wedge.data(), ortho ? rays.ox : rays.dx, ortho ? rays.oy : rays.dy,
                 ortho ? rays.oz : rays.dz, rays.ox, rays.oy, rays.oz, rays.dx, rays.dy, rays.dz, i,
                 hits.t, hits.index);
  }
}

V3f SurfaceSampler::onPlane(int x, int y, const Rays& rays, int k) const {
  const V3f p = surface_.relative(x, y), n = surface_.normal(x, y);
  const V3f o = rays.origin(k), d = rays.direction(k);
  const float own = (p - o).dot(d) / d.length2();
  float t = (p - o).dot(n) / d.dot(n);
  // Seen edge-on, or without a normal, the plane says nothing: keep the distance of P.
  if (!(std::fabs(t - own) <= 0.25f * std::fabs(own))) t = own;
  return rayPoint(o, d, t);
}

bool SurfaceSampler::beyondSilhouette(int x, int y, int k, int& column, int& row) const {
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
    column = x + step[0];
    row = y + step[1];
    if (surface_.ids.contains(column, row) && !sight_.casters().holds(surface_.ids(column, row)))
      return true;
  }
  return false;
}

bool SurfaceSampler::seenAround(int x, int y, uint32_t id) const {
  for (int row = y - 1; row <= y + 1; ++row)
    for (int column = x - 1; column <= x + 1; ++column)
      if (surface_.ids.contains(column, row) && surface_.ids(column, row) == id) return true;
  return false;
}

void SurfaceSampler::sample(int x, int y, SubpixelPoints& points) {
  const Rays rays(surface_.rays, x, y);
  const bool explained = explain(x, y, rays);
  Hits hits;
  findHits(rays, hits);
  points.present = 0;
  for (int k = 0; k < 64; ++k) {
    const uint32_t hitId = hits.index[k] < 0 ? 0 : pixel_.id[hits.index[k]];
    const V3f hit = rayPoint(rays.origin(k), rays.direction(k), hits.t[k]);
    V3f point = hit;
    uint32_t id = hitId;
    int column, row;
    if (!explained) {
      id = surface_.ids(x, y);
      point = onPlane(x, y, rays, k);
      const float gap = (point - hit).dot(rays.direction(k));
      if (hitId != 0 && gap > nearRelative * point.length() && seenAround(x, y, hitId)) {
        id = hitId;
        point = hit;
      }
    } else if (hitId == 0) {
      id = surface_.ids(x, y);
      if (beyondSilhouette(x, y, k, column, row)) {
        if (!surface_.isSurface(column, row)) continue;
        id = surface_.ids(column, row);
        point = onPlane(column, row, rays, k);
      } else {
        point = onPlane(x, y, rays, k);
      }
    }
    points.x[k] = point.x;
    points.y[k] = point.y;
    points.z[k] = point.z;
    points.id[k] = id;
    points.present |= uint64_t{1} << k;
  }
  for (int k = 0; k < 64; ++k)
    if (!(points.present >> k & 1)) points.x[k] = points.y[k] = points.z[k] = farAway;
}

}  // namespace kagefude
