#include "passes/surface_sampler.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"

namespace kagefude {
namespace {

constexpr float farAway = 3e38f;
/// How far P may lie from its triangle: in widths of a pixel, and relative to its distance.
constexpr float nearPixels = 0.05f, nearRelative = 2e-5f;
/// How far beyond a triangle's edge P may lie, as a share of half a pixel.
constexpr float edgeShare = 0.02f;

float sideAt(const float* plane, const V3f& q) {
  return plane[0] * q.x + plane[1] * q.y + plane[2] * q.z - plane[3];
}

/// Half the change of a side's value across the pixel.
float sideReach(const float* plane, const V3f& stepX, const V3f& stepY) {
  const V3f n(plane[0], plane[1], plane[2]);
  return 0.5f * (std::fabs(n.dot(stepX)) + std::fabs(n.dot(stepY)));
}

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

/// base + x step + y step at the sub-pixels, x and y from -1/2 to 1/2.
KAGEFUDE_CLONES void spread(float base, float stepX, float stepY, float* values) {
  for (int k = 0; k < 64; ++k) {
    const float x = (static_cast<float>(k % 8) - 3.5f) * 0.125f;
    const float y = (static_cast<float>(k / 8) - 3.5f) * 0.125f;
    values[k] = base + (stepX * x + stepY * y);
  }
}

}  // namespace

struct SurfaceSampler::Rays {
  alignas(64) float o[3][64];
  alignas(64) float d[3][64];

  Rays(const CameraRays& camera, int column, int row) {
    const V3d origin = camera.origin(column + 0.5, row + 0.5);
    const V3d direction = camera.direction(column + 0.5, row + 0.5);
    const auto single = [](double value) { return static_cast<float>(value); };
    for (int i = 0; i < 3; ++i) {
      spread(single(origin[i]), single(camera.originX[i]), single(camera.originY[i]), o[i]);
      spread(single(direction[i]), single(camera.directionX[i]), single(camera.directionY[i]),
             d[i]);
    }
  }
  Ray operator[](int k) const { return {{o[0][k], o[1][k], o[2][k]}, {d[0][k], d[1][k], d[2][k]}}; }
};

struct SurfaceSampler::Hits {
  alignas(64) float t[64];
  alignas(64) int index[64];
};

void SurfaceSampler::startTile(int x0, int y0, int x1, int y1) {
  x0_ = x0;
  y0_ = y0;
  x1_ = x1;
  y1_ = y1;
  gathered_ = false;
}

SurfaceSampler::Ray SurfaceSampler::ray(double x, double y) const {
  return {V3f(surface_.rays.origin(x, y)), V3f(surface_.rays.direction(x, y))};
}

void SurfaceSampler::gatherTile() {
  const auto corner = [&](int column, int row) {
    const Ray r = ray(column, row);
    return surface_.rays.orthographic ? r.origin : r.direction;
  };
  sight_.gatherSeen({corner(x0_, y0_), corner(x1_, y0_), corner(x1_, y1_), corner(x0_, y1_)},
                    tile_);
  touching_.resize(static_cast<size_t>(tile_.count));
  gathered_ = true;
}

void SurfaceSampler::findCandidates() {
  const Ray middle = ray(x_ + 0.5, y_ + 0.5);
  const CameraRays& camera = surface_.rays;
  centre_ = camera.orthographic ? middle.origin : middle.direction;
  stepX_ = V3f(camera.orthographic ? camera.originX : camera.directionX);
  stepY_ = V3f(camera.orthographic ? camera.originY : camera.directionY);
  const float* rows[wedgeCoefficients];
  for (int k = 0; k < wedgeCoefficients; ++k) rows[k] = tile_.coefficients[k].data();
  pixelTouches(rows, tile_.count, &centre_.x, &stepX_.x, &stepY_.x, touching_.data());
  candidates_.clear();
  for (int i = 0; i < tile_.count; ++i)
    if (touching_[i] && tile_.id[i] != 0) candidates_.push_back(i);
}

void SurfaceSampler::judgeCentre(int candidate, float tolerance) {
  const std::array<float, wedgeCoefficients> wedge = tile_.wedge(candidate);
  bool through = true, nearly = true;
  for (int plane = 0; plane < 3; ++plane) {
    const float* side = wedge.data() + 4 * plane;
    const float value = sideAt(side, centre_);
    through &= value >= 0;
    // The renderer may have rounded the other way at a triangle's very edge.
    nearly &= value >= -edgeShare * sideReach(side, stepX_, stepY_);
  }
  const float behind = sideAt(wedge.data() + 12, surface_.relative(x_, y_));
  if (nearly && std::fabs(behind) <= tolerance)
    own_ = candidate;
  else if (through && behind > 0)
    hidden_.push_back(tile_.id[candidate]);
}

bool SurfaceSampler::coversPixel(int candidate) const {
  const std::array<float, wedgeCoefficients> wedge = tile_.wedge(candidate);
  for (int plane = 0; plane < 3; ++plane) {
    const float* side = wedge.data() + 4 * plane;
    if (!(sideAt(side, centre_) >= sideReach(side, stepX_, stepY_))) return false;
  }
  return true;
}

bool SurfaceSampler::liesBehind(int candidate, const std::array<Ray, 4>& corners,
                                float farthest) const {
  const std::array<float, wedgeCoefficients> wedge = tile_.wedge(candidate);
  for (const Ray& corner : corners) {
    const V3f n(wedge[12], wedge[13], wedge[14]);
    const float speed = n.dot(corner.direction);
    if (!(speed > 0) || !(wedge[15] - n.dot(corner.origin) > farthest * speed)) return false;
  }
  return true;
}

bool SurfaceSampler::onOneTriangle(const std::array<Ray, 4>& corners,
                                   std::array<V3f, 4>& found) const {
  if (!coversPixel(own_)) return false;
  const std::array<float, wedgeCoefficients> wedge = tile_.wedge(own_);
  const V3f n(wedge[12], wedge[13], wedge[14]);
  float farthest = 0;
  for (int k = 0; k < 4; ++k) {
    const Ray& corner = corners[k];
    const float t = (wedge[15] - n.dot(corner.origin)) / n.dot(corner.direction);
    if (!(t > 0 && t < farAway)) return false;
    found[k] = lifted(corner.origin + corner.direction * t, own_);
    farthest = std::max(farthest, t);
  }
  return std::all_of(candidates_.begin(), candidates_.end(), [&](int i) {
    return i == own_ || isHidden(i) || liesBehind(i, corners, farthest);
  });
}

bool SurfaceSampler::locate(int x, int y, float lift, FlatPixel& flat) {
  x_ = x;
  y_ = y;
  lift_ = lift;
  if (!gathered_) gatherTile();
  findCandidates();
  hidden_.clear();
  own_ = -1;
  const float tolerance =
      nearPixels * surface_.pixelSize(x, y) + nearRelative * surface_.relative(x, y).length();
  for (int i : candidates_) judgeCentre(i, tolerance);
  explained_ = own_ >= 0;
  const std::array<Ray, 4> corners = {ray(x, y), ray(x + 1, y), ray(x + 1, y + 1), ray(x, y + 1)};
  if (explained_) {
    flat.id = tile_.id[own_];
    return onOneTriangle(corners, flat.corners);
  }
  flat.id = surface_.ids(x, y);
  for (int k = 0; k < 4; ++k) flat.corners[k] = onPlane(x, y, corners[k]);
  return candidates_.empty();
}

bool SurfaceSampler::isHidden(int candidate) const {
  return std::find(hidden_.begin(), hidden_.end(), tile_.id[candidate]) != hidden_.end();
}

void SurfaceSampler::findHits(const Rays& rays, Hits& hits) const {
  std::fill_n(hits.t, 64, farAway);
  std::fill_n(hits.index, 64, -1);
  const auto& q = surface_.rays.orthographic ? rays.o : rays.d;
  for (int i : candidates_) {
    if (isHidden(i)) continue;
    const std::array<float, wedgeCoefficients> wedge = tile_.wedge(i);
    meetTriangle(wedge.data(), q[0], q[1], q[2], rays.o[0], rays.o[1], rays.o[2], rays.d[0],
                 rays.d[1], rays.d[2], i, hits.t, hits.index);
  }
}

V3f SurfaceSampler::lifted(const V3f& point, int candidate) const {
  const auto& c = tile_.coefficients;
  return point - V3f(c[12][candidate], c[13][candidate], c[14][candidate]) * lift_;
}

V3f SurfaceSampler::onPlane(int x, int y, const Ray& ray) const {
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

bool SurfaceSampler::settle(int k, const Ray& ray, uint32_t hitId, const V3f& hit, V3f& point,
                            uint32_t& id) const {
  point = hit;
  id = hitId;
  if (explained_ && hitId != 0) return true;
  int column = x_, row = y_;
  if (explained_ && (!beyondSilhouette(k, column, row) || !surface_.isSurface(column, row)))
    return false;
  const V3f plane = onPlane(column, row, ray);
  const bool before = (plane - hit).dot(ray.direction) > nearRelative * plane.length();
  if (hitId != 0 && before && seenAround(hitId)) return true;
  point = plane;
  id = surface_.ids(column, row);
  return true;
}

void SurfaceSampler::sample(SubpixelPoints& points) {
  const Rays rays(surface_.rays, x_, y_);
  Hits hits;
  findHits(rays, hits);
  points.present = 0;
  for (int k = 0; k < 64; ++k) {
    const Ray ray = rays[k];
    const uint32_t hitId = hits.index[k] < 0 ? 0 : tile_.id[hits.index[k]];
    V3f hit = ray.origin + ray.direction * hits.t[k];
    if (hitId != 0) hit = lifted(hit, hits.index[k]);
    V3f point;
    if (settle(k, ray, hitId, hit, point, points.id[k]))
      points.present |= uint64_t{1} << k;
    else
      point = V3f(farAway);
    points.x[k] = point.x;
    points.y[k] = point.y;
    points.z[k] = point.z;
  }
}

}  // namespace kagefude
