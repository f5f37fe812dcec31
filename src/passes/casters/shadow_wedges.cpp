#include "passes/casters/shadow_wedges.h"

#include <cmath>

#include "passes/casters/shaft.h"

namespace kagefude {
namespace {

/// Rounding of q relative to its size; boxes grow by it before they are tested.
constexpr float slack = 2e-6f;
/// Below this sine between light and triangle the triangle is a line and throws no shadow.
constexpr double edgeOn = 1e-9;
/// Added to the value of a side that is no edge of the shadow, so that it is never negative.
constexpr float carriedOn = 1e30f;

struct WedgePlanes {
  float c[wedgeCoefficients];
};

constexpr WedgePlanes emptyWedge = {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};

void setPlane(WedgePlanes& wedge, int plane, const V3d& normal, double offset) {
  for (int i = 0; i < 3; ++i) wedge.c[4 * plane + i] = static_cast<float>(normal[i]);
  wedge.c[4 * plane + 3] = static_cast<float>(offset);
}

/// The side through the edge ab. Swapping a and b changes nothing but the sign.
V3d sideNormal(const V3d& a, const V3d& b, bool directional, const V3d& direction) {
  return directional ? direction.cross(b - a) : a.cross(b);
}

double sideOffset(const V3d& a, const V3d& b, bool directional, const V3d& direction) {
  return directional ? b.cross(a).dot(direction) : 0.0;
}

WedgePlanes wedgeOf(const CasterSet::Triangle& triangle, const V3d& origin, bool directional,
                    const V3d& direction) {
  if (!triangle.valid) return emptyWedge;
  const V3d corner[3] = {V3d(triangle.a) - origin, V3d(triangle.b) - origin,
                         V3d(triangle.c) - origin};
  V3d face = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double area = face.length();
  if (!(area > 0)) return emptyWedge;
  face /= area;
  // Positive where light passes from the side that the face's normal points away from.
  const double facing = directional ? face.dot(direction) : face.dot(corner[0]);
  const double distance = directional ? 1.0 : corner[0].length();
  if (!(std::fabs(facing) > edgeOn * distance)) return emptyWedge;
  WedgePlanes wedge;
  const double sign = facing > 0 ? 1.0 : -1.0;
  for (int i = 0; i < 3; ++i) {
    const V3d &a = corner[i], &b = corner[(i + 1) % 3];
    const V3d normal = sideNormal(a, b, directional, direction) * sign;
    const double offset = sideOffset(a, b, directional, direction) * sign;
    setPlane(wedge, i, normal, offset);
    const bool beyond = normal.dot(V3d(triangle.across[i]) - origin) < offset;
    wedge.c[16 + i] = triangle.shared[i] && beyond ? carriedOn : 0.0f;
  }
  setPlane(wedge, 3, face * sign, face.dot(corner[0]) * sign);
  return wedge;
}

}  // namespace

ShadowWedges::ShadowWedges(const CasterSet& casters, const LightPlace& light, const V3d& eye)
    : casters_(casters), directional_(light.directional), eye_(eye), blocks_(casters.blocks()) {
  const V3d apex = directional_ ? eye : light.position;
  const V3d direction =
      light.direction.length2() > 0 ? light.direction.normalized() : V3d(0, 0, -1);
  apex_ = V3f(apex - eye);
  direction_ = V3f(direction);
  // Through the float that points are later made relative to, so that both see one apex.
  const V3d origin = eye + V3d(apex_);
  for (size_t i = 0; i < casters.triangles().size(); ++i) {
    const CasterSet::Triangle& t = casters.triangles()[i];
    const WedgePlanes wedge = wedgeOf(t, origin, directional_, direction);
    Block& block = blocks_[i / wedgeLanes];
    for (int k = 0; k < wedgeCoefficients; ++k) block.c[k][i % wedgeLanes] = wedge.c[k];
    block.id[i % wedgeLanes] = t.id;
  }
}

template <class NodeTest, class Leaf>
void ShadowWedges::descend(const NodeTest& test, const Leaf& leaf) const {
  if (casters_.empty()) return;
  const V3d origin = eye_ + V3d(apex_);
  std::array<uint32_t, 128> stack;
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const CasterSet::Node& node = casters_.nodes()[stack[--depth]];
    const V3f low(V3d(node.low) - origin), high(V3d(node.high) - origin);
    if (!test(low, high)) continue;
    if (node.leaf) {
      const Block& block = blocks_[node.first];
      const float* rows[wedgeCoefficients];
      for (int k = 0; k < wedgeCoefficients; ++k) rows[k] = block.c[k];
      if (!leaf(rows, block.id)) return;
    } else {
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
    }
  }
}

BoxState ShadowWedges::gather(const PointBox& box, float bias, WedgeList& found) const {
  found.clear();
  PointBox local = box;
  local.centre -= apex_;
  for (int i = 0; i < 3; ++i) local.half[i] += slack * (std::fabs(local.centre[i]) + local.half[i]);
  const Shaft shaft = Shaft::toLight(local, directional_, direction_);
  BoxVerdict verdict(local, bias);
  descend([&](const V3f& low, const V3f& high) { return shaft.mayTouch(low, high); },
          [&](const float* const* rows, const uint32_t* id) {
            verdict.look(rows, wedgeLanes);
            for (int lane = 0; lane < wedgeLanes; ++lane)
              if (verdict.add(lane)) found.append(rows, lane, id[lane]);
            return !verdict.settled();
          });
  found.pad();
  return verdict.state();
}

void ShadowWedges::gatherSeen(const std::array<V3f, 4>& corners, WedgeList& found) const {
  found.clear();
  const Shaft shaft = Shaft::ofSight(corners, directional_, direction_);
  const auto reaches = [&](const float* const* rows, int lane, int plane) {
    for (const V3f& q : corners) {
      const float side = rows[4 * plane][lane] * q.x + rows[4 * plane + 1][lane] * q.y +
                         rows[4 * plane + 2][lane] * q.z - rows[4 * plane + 3][lane];
      if (side >= -slack * std::fabs(rows[4 * plane + 3][lane])) return true;
    }
    return false;
  };
  descend([&](const V3f& low, const V3f& high) { return shaft.mayTouch(low, high); },
          [&](const float* const* rows, const uint32_t* id) {
            for (int lane = 0; lane < wedgeLanes; ++lane)
              if (reaches(rows, lane, 0) && reaches(rows, lane, 1) && reaches(rows, lane, 2))
                found.append(rows, lane, id[lane]);
            return true;
          });
  found.pad();
}

}  // namespace kagefude
