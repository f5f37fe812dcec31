#include "passes/casters/shaft.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kagefude {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Rounding of a dot product relative to its terms; planes are moved out by it.
constexpr float slack = 4e-6f;

}  // namespace

void Shaft::addPlane(const V3f& normal, float offset) {
  normals_[count_] = normal;
  offsets_[count_] = offset;
  ++count_;
}

void Shaft::addTangents(int u, int v, const PointBox& box) {
  const float lowU = box.centre[u] - box.half[u], highU = box.centre[u] + box.half[u];
  const float lowV = box.centre[v] - box.half[v], highV = box.centre[v] + box.half[v];
  if (lowU <= 0 && highU >= 0 && lowV <= 0 && highV >= 0) return;
  const V2f corners[4] = {{lowU, lowV}, {highU, lowV}, {highU, highV}, {lowU, highV}};
  V2f right = corners[0], left = corners[0];
  for (const V2f& c : corners) {
    if (right.x * c.y - right.y * c.x < 0) right = c;
    if (left.x * c.y - left.y * c.x > 0) left = c;
  }
  V3f normal(0.0f);
  normal[u] = -right.y;
  normal[v] = right.x;
  addPlane(normal, 0);
  normal[u] = left.y;
  normal[v] = -left.x;
  addPlane(normal, 0);
}

void Shaft::addParallels(int u, int v, const PointBox& box, const V3f& direction) {
  V3f normal(0.0f);
  normal[u] = -direction[v];
  normal[v] = direction[u];
  const float middle = normal.dot(box.centre);
  const float reach = std::fabs(normal[u]) * box.half[u] + std::fabs(normal[v]) * box.half[v];
  addPlane(normal, middle - reach);
  addPlane(-normal, -middle - reach);
}

Shaft Shaft::toLight(const PointBox& box, bool directional, const V3f& direction) {
  Shaft shaft;
  shaft.low_ = box.centre - box.half;
  shaft.high_ = box.centre + box.half;
  for (int i = 0; i < 3; ++i) {
    if (directional) {
      if (direction[i] > 0) shaft.low_[i] = -infinity;
      if (direction[i] < 0) shaft.high_[i] = infinity;
    } else {
      shaft.low_[i] = std::min(shaft.low_[i], 0.0f);
      shaft.high_[i] = std::max(shaft.high_[i], 0.0f);
    }
  }
  for (int u = 0; u < 3; ++u) {
    const int v = (u + 1) % 3;
    if (directional)
      shaft.addParallels(u, v, box, direction);
    else
      shaft.addTangents(u, v, box);
  }
  return shaft;
}

Shaft Shaft::ofSight(const std::array<V3f, 4>& corners, bool directional, const V3f& direction) {
  Shaft shaft;
  shaft.low_ = V3f(-infinity);
  shaft.high_ = V3f(infinity);
  const V3f middle = (corners[0] + corners[1] + corners[2] + corners[3]) * 0.25f;
  for (int i = 0; i < 4; ++i) {
    const V3f &a = corners[i], &b = corners[(i + 1) % 4];
    V3f normal = directional ? (b - a).cross(direction) : a.cross(b);
    float offset = directional ? normal.dot(a) : 0;
    if (normal.dot(middle) < offset) {
      normal = -normal;
      offset = -offset;
    }
    shaft.addPlane(normal, offset);
  }
  return shaft;
}

bool Shaft::mayTouch(const V3f& low, const V3f& high) const {
  for (int i = 0; i < 3; ++i)
    if (low[i] > high_[i] || high[i] < low_[i]) return false;
  for (int k = 0; k < count_; ++k) {
    const V3f& n = normals_[k];
    float reach = 0, size = std::fabs(offsets_[k]);
    for (int i = 0; i < 3; ++i) {
      reach += n[i] * (n[i] > 0 ? high[i] : low[i]);
      size += std::fabs(n[i]) * std::max(std::fabs(high[i]), std::fabs(low[i]));
    }
    if (reach < offsets_[k] - slack * size) return false;
  }
  return true;
}

}  // namespace kagefude
