#include "passes/map_receiver.h"

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

constexpr float steepest = 8.0f;  ///< tangent of the steepest slope that is followed

struct OnMap {
  double u, v, w;
};

OnMap project(const ShadowMap& map, const V3d& inLight) {
  const V4d clip = map.clipFromLight.homogeneous(inLight);
  return {(clip[0] / clip[3] * 0.5 + 0.5) * map.depth.width,
          (0.5 - clip[1] / clip[3] * 0.5) * map.depth.height, clip[3]};
}

double baseOf(const MapReceiver& r, double depth) { return r.perspective ? 1.0 / depth : depth; }

/// Slope of `base` over the map, from two steps along the tangent plane. On a plane both depth
/// (orthographic) and its inverse (perspective) are linear in the map's coordinates, so two steps
/// of any length give the exact slope.
void findSlope(const ShadowMap& map, const V3d& p, const V3d& normal, MapReceiver& r) {
  const double length = normal.length();
  if (!(length > 0)) return;
  const V3d n = normal / length;
  const V3d other = std::fabs(n.x) < 0.6 ? V3d(1, 0, 0) : V3d(0, 1, 0);
  const V3d t = n.cross(other).normalized(), b = n.cross(t);
  const double step = 0.25 / r.texelsPerUnit;
  const V3d p1 = p + t * step, p2 = p + b * step;
  if (r.perspective && (p1.z >= 0 || p2.z >= 0)) return;
  const OnMap o = project(map, p), o1 = project(map, p1), o2 = project(map, p2);
  const double du1 = o1.u - o.u, dv1 = o1.v - o.v, du2 = o2.u - o.u, dv2 = o2.v - o.v;
  const double det = du1 * dv2 - du2 * dv1;
  if (!(std::fabs(det) > 1e-9)) return;
  const double q = baseOf(r, -p.z), q1 = baseOf(r, -p1.z) - q, q2 = baseOf(r, -p2.z) - q;
  r.slopeU = static_cast<float>((q1 * dv2 - q2 * dv1) / det);
  r.slopeV = static_cast<float>((q2 * du1 - q1 * du2) / det);
}

}  // namespace

float MapReceiver::planeDepth(float du, float dv, float follow) const {
  const float here = base + slopeU * du + slopeV * dv;
  const float plane = perspective ? (here > 0 ? 1.0f / here : 3e38f) : here;
  const float most = limit * (std::fabs(du) + std::fabs(dv));
  return depth + follow * std::clamp(plane - depth, -most, most);
}

MapReceiver::Bounds MapReceiver::planeDepthBounds(float radius, float follow) const {
  const float change = std::sqrt(slopeU * slopeU + slopeV * slopeV) * radius * 1.0001f;
  const float most = limit * radius * 1.4143f;
  float low = base - change, high = base + change;
  if (perspective) {
    const float nearest = 1.0f / high, farthest = low > 0 ? 1.0f / low : 3e38f;
    low = nearest;
    high = farthest;
  }
  const float slack = 1e-5f * std::fabs(depth);
  return {depth + follow * std::max(low - depth, -most) - slack,
          depth + follow * std::min(high - depth, most) + slack};
}

std::optional<MapReceiver> receiveOnMap(const ShadowMap& map, const V3f& position,
                                        const V3f& normal) {
  const V3d p = map.lightFromWorld.point(V3d(position));
  const OnMap place = project(map, p);
  const bool seen = place.w > 0 && std::fabs(place.u) < 1e9 && std::fabs(place.v) < 1e9;
  if (!seen) return std::nullopt;
  MapReceiver r;
  const auto& m = map.clipFromLight.m;
  r.perspective = m[3][2] != 0;
  if (r.perspective && !(p.z < 0)) return std::nullopt;
  r.u = static_cast<float>(place.u);
  r.v = static_cast<float>(place.v);
  r.depth = static_cast<float>(-p.z);
  r.texelsPerUnit = static_cast<float>(0.5 * map.depth.width * std::fabs(m[0][0]) / place.w);
  r.base = static_cast<float>(baseOf(r, -p.z));
  r.limit = steepest / r.texelsPerUnit;
  const V3d n = map.lightFromWorld.direction(V3d(normal));
  r.turnedAway = (r.perspective ? -n.dot(p) : n.z) < 0;
  if (!r.turnedAway) findSlope(map, p, n, r);
  return r;
}

}  // namespace kagefude
