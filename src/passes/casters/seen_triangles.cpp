#include "passes/casters/seen_triangles.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"

namespace kagefude {
namespace {

/// How far P may lie from its triangle: in widths of a pixel, and relative to its distance.
constexpr float nearPixels = 0.05f, nearRelative = 2e-5f;
/// How far beyond a triangle's edge P may lie, as a share of half a pixel.
constexpr float edgeShare = 0.02f;
/// Rounding of a light's height over a triangle's plane, relative to the distances, with some to
/// spare.
constexpr double sureSide = 1e-6;

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

}  // namespace

void SeenTriangles::startTile(int x0, int y0, int x1, int y1) {
  x0_ = x0;
  y0_ = y0;
  x1_ = x1;
  y1_ = y1;
  gathered_ = false;
}

SightRay SeenTriangles::ray(double x, double y) const {
  return {V3f(surface_.rays.origin(x, y)), V3f(surface_.rays.direction(x, y))};
}

void SeenTriangles::gatherTile() {
  const auto corner = [&](int column, int row) {
    const SightRay r = ray(column, row);
    return surface_.rays.orthographic ? r.origin : r.direction;
  };
  sight_.gatherSeen({corner(x0_, y0_), corner(x1_, y0_), corner(x1_, y1_), corner(x0_, y1_)},
                    tile_);
  touching_.resize(static_cast<size_t>(tile_.count));
  gathered_ = true;
}

void SeenTriangles::findTouching() {
  const SightRay middle = ray(x_ + 0.5, y_ + 0.5);
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

void SeenTriangles::judgeCentre(int candidate, float tolerance) {
  const std::array<float, wedgeCoefficients> planes = wedge(candidate);
  bool through = true, nearly = true;
  for (int plane = 0; plane < 3; ++plane) {
    const float* side = planes.data() + 4 * plane;
    const float value = sideAt(side, centre_);
    through &= value >= 0;
    // The renderer may have rounded the other way at a triangle's very edge.
    nearly &= value >= -edgeShare * sideReach(side, stepX_, stepY_);
  }
  const float behind = sideAt(planes.data() + 12, surface_.relative(x_, y_));
  if (nearly && std::fabs(behind) <= tolerance)
    own_ = candidate;
  else if (through && behind > 0)
    before_.push_back(candidate);
}

bool SeenTriangles::isUnseen(int candidate) const {
  return std::any_of(before_.begin(), before_.end(), [&](int i) {
    // Of the object under the centre only the triangle itself may be unseen.
    return i == candidate || (id(i) == id(candidate) && (own_ < 0 || id(i) != id(own_)));
  });
}

void SeenTriangles::find(int x, int y) {
  x_ = x;
  y_ = y;
  if (!gathered_) gatherTile();
  findTouching();
  own_ = -1;
  const float tolerance =
      nearPixels * surface_.pixelSize(x, y) + nearRelative * surface_.relative(x, y).length();
  before_.clear();
  for (int i : candidates_) judgeCentre(i, tolerance);
  if (!before_.empty()) std::erase_if(candidates_, [&](int i) { return isUnseen(i); });
}

V3f SeenTriangles::normal(int candidate) const {
  const auto& c = tile_.coefficients;
  return {c[12][candidate], c[13][candidate], c[14][candidate]};
}

float SeenTriangles::distance(int candidate, const SightRay& ray) const {
  const V3f n = normal(candidate);
  return (tile_.coefficients[15][candidate] - n.dot(ray.origin)) / n.dot(ray.direction);
}

bool SeenTriangles::coversPixel(int candidate) const {
  const std::array<float, wedgeCoefficients> planes = wedge(candidate);
  for (int plane = 0; plane < 3; ++plane) {
    const float* side = planes.data() + 4 * plane;
    if (!(sideAt(side, centre_) >= sideReach(side, stepX_, stepY_))) return false;
  }
  return true;
}

bool SeenTriangles::liesBehind(int candidate, const std::array<SightRay, 4>& corners,
                               float farthest) const {
  const V3f n = normal(candidate);
  for (const SightRay& corner : corners) {
    const float speed = n.dot(corner.direction);
    const float height = tile_.coefficients[15][candidate] - n.dot(corner.origin);
    if (!(speed > 0) || !(height > farthest * speed)) return false;
  }
  return true;
}

bool SeenTriangles::facesAway(int candidate) const {
  const V3d n(normal(candidate));
  if (light_.directional) return -n.dot(light_.direction) > sureSide * light_.direction.length();
  const V3d toLight = light_.position - surface_.rays.eye;
  const double plane = tile_.coefficients[15][candidate];
  return n.dot(toLight) - plane > sureSide * (toLight.length() + std::fabs(plane));
}

}  // namespace kagefude
