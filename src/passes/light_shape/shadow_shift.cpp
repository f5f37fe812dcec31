#include "passes/light_shape/shadow_shift.h"

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

constexpr float grazing = 0.12f;    ///< cosine to the light up to which nothing is followed
constexpr float facingWell = 0.3f;  ///< and from which on shifts are trusted fully

/// Change of position along one axis of the picture, on the tangent plane, from the neighbour that
/// lies closer to it.
V3f stepAlong(int x, int y, int dx, int dy, View<const uint32_t> labels, Vec3View position,
              const V3f& n) {
  const V3f p = position(x, y);
  V3f best(0, 0, 0);
  float off = INFINITY;
  for (const int sign : {1, -1}) {
    const int qx = x + sign * dx, qy = y + sign * dy;
    if (!labels.contains(qx, qy) || labels(qx, qy) != labels(x, y)) continue;
    const V3f d = (position(qx, qy) - p) * static_cast<float>(sign);
    if (std::fabs(d.dot(n)) < off) {
      off = std::fabs(d.dot(n));
      best = d - n * d.dot(n);
    }
  }
  return best;
}

/// The longest shift of the unit circle: the larger singular value.
float longestOf(const ShadowShift& s) {
  const float sum = s.ux * s.ux + s.uy * s.uy + s.vx * s.vx + s.vy * s.vy;
  const float cross = s.ux * s.vy - s.uy * s.vx;
  return std::sqrt(0.5f * (sum + std::sqrt(std::max(0.0f, sum * sum - 4.0f * cross * cross))));
}

}  // namespace

ShadowShift shadowShiftAt(int x, int y, View<const uint32_t> labels, Vec3View position,
                          Vec3View normal, const LightGeometry& geometry) {
  const V3f p = position(x, y), n = normal(x, y);
  const V3f px = stepAlong(x, y, 1, 0, labels, position, n);
  const V3f py = stepAlong(x, y, 0, 1, labels, position, n);
  const float xx = px.dot(px), xy = px.dot(py), yy = py.dot(py), det = xx * yy - xy * xy;
  const V3f travel = geometry.sun ? geometry.direction : (p - geometry.position).normalized();
  const float facing = n.dot(travel);
  ShadowShift result;
  if (!(det > 1e-4f * xx * yy) || !(facing < -grazing)) return result;
  const auto onPicture = [&](const V3f& move, float& outX, float& outY) {
    const V3f shift = travel * (n.dot(move) / facing) - move;
    const float sx = shift.dot(px), sy = shift.dot(py);
    outX = (yy * sx - xy * sy) / det;
    outY = (xx * sy - xy * sx) / det;
  };
  onPicture(geometry.u, result.ux, result.uy);
  onPicture(geometry.v, result.vx, result.vy);
  const float most = longestOf(result);
  if (!(most > 0) || !std::isfinite(most)) return result;
  for (float* const v : {&result.ux, &result.uy, &result.vx, &result.vy}) *v /= most;
  result.trust = std::min((-facing - grazing) / (facingWell - grazing), 1.0f);
  result.valid = true;
  return result;
}

}  // namespace kagefude
