#include "passes/shadow_wedges.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/clones.h"
#include "passes/shaft.h"

namespace kagefude {
namespace {

/// Rounding of q relative to its size; boxes grow by it before they are tested.
constexpr float slack = 2e-6f;
/// Below this sine between light and triangle the triangle is a line and throws no shadow.
constexpr double edgeOn = 1e-9;

struct WedgePlanes {
  float c[wedgeCoefficients];
};

constexpr WedgePlanes emptyWedge = {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}};

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

WedgePlanes wedgeOf(const std::array<V3d, 3>& corner, bool directional, const V3d& direction) {
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
    setPlane(wedge, i, sideNormal(a, b, directional, direction) * sign,
             sideOffset(a, b, directional, direction) * sign);
  }
  setPlane(wedge, 3, face * sign, face.dot(corner[0]) * sign);
  return wedge;
}

KAGEFUDE_CLONES void boxStates(const float* const* c, int count, const float* centre,
                               const float* half, float bias, uint8_t* touching, uint8_t* inside) {
  for (int i = 0; i < count; ++i) {
    float most = 1e30f, least = 1e30f;
    for (int plane = 0; plane < 4; ++plane) {
      const float nx = c[4 * plane][i], ny = c[4 * plane + 1][i], nz = c[4 * plane + 2][i];
      const float middle = nx * centre[0] + ny * centre[1] + nz * centre[2] - c[4 * plane + 3][i];
      const float reach =
          std::fabs(nx) * half[0] + std::fabs(ny) * half[1] + std::fabs(nz) * half[2];
      const float high = middle + reach;
      const float low = middle - reach - (plane == 3 ? bias : 0.0f);
      most = high < most ? high : most;
      least = low < least ? low : least;
    }
    touching[i] = most >= 0.0f ? 1 : 0;
    inside[i] = least >= 0.0f ? 1 : 0;
  }
}

KAGEFUDE_CLONES void insideBytes(const float* c, const float* x, const float* y, const float* z,
                                 float bias, uint8_t* inside) {
  for (int i = 0; i < 64; ++i) {
    const float s0 = c[0] * x[i] + c[1] * y[i] + c[2] * z[i] - c[3];
    const float s1 = c[4] * x[i] + c[5] * y[i] + c[6] * z[i] - c[7];
    const float s2 = c[8] * x[i] + c[9] * y[i] + c[10] * z[i] - c[11];
    const float s3 = c[12] * x[i] + c[13] * y[i] + c[14] * z[i] - c[15] - bias;
    inside[i] = (s0 >= 0.0f) & (s1 >= 0.0f) & (s2 >= 0.0f) & (s3 >= 0.0f);
  }
}

PointBox grown(const PointBox& box) {
  PointBox result = box;
  for (int i = 0; i < 3; ++i) result.half[i] += slack * (std::fabs(box.centre[i]) + box.half[i]);
  return result;
}

}  // namespace

bool PointBox::contains(const PointBox& inner) const {
  for (int i = 0; i < 3; ++i)
    if (!(std::fabs(inner.centre[i] - centre[i]) + inner.half[i] <= half[i])) return false;
  return true;
}

void WedgeList::reserve(int wedges) {
  const size_t size = static_cast<size_t>(wedges + wedgeLanes);
  if (id.size() >= size) return;
  for (auto& values : coefficients) values.resize(size * 2);
  id.resize(size * 2);
}

void WedgeList::append(const float* const* source, int lane, uint32_t sourceId) {
  reserve(count + 1);
  for (int k = 0; k < wedgeCoefficients; ++k) coefficients[k][count] = source[k][lane];
  id[count] = sourceId;
  ++count;
}

void WedgeList::pad() {
  reserve(count);
  for (int i = count; i % wedgeLanes != 0; ++i)
    for (int k = 0; k < wedgeCoefficients; ++k) coefficients[k][i] = emptyWedge.c[k];
}

std::array<float, wedgeCoefficients> WedgeList::wedge(int index) const {
  std::array<float, wedgeCoefficients> result;
  for (int k = 0; k < wedgeCoefficients; ++k) result[k] = coefficients[k][index];
  return result;
}

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
    const WedgePlanes wedge =
        t.valid ? wedgeOf({V3d(t.a) - origin, V3d(t.b) - origin, V3d(t.c) - origin}, directional_,
                          direction)
                : emptyWedge;
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
  local = grown(local);
  const Shaft shaft = Shaft::toLight(local, directional_, direction_);
  bool covered = false;
  descend([&](const V3f& low, const V3f& high) { return shaft.mayTouch(low, high); },
          [&](const float* const* rows, const uint32_t* id) {
            uint8_t touching[wedgeLanes], inside[wedgeLanes];
            boxStates(rows, wedgeLanes, &local.centre.x, &local.half.x, bias, touching, inside);
            for (int lane = 0; lane < wedgeLanes; ++lane) {
              covered |= inside[lane] != 0;
              if (touching[lane]) found.append(rows, lane, id[lane]);
            }
            return !covered;
          });
  found.pad();
  if (covered) return BoxState::inside;
  return found.empty() ? BoxState::apart : BoxState::touching;
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

BoxState filterWedges(const WedgeList& list, const PointBox& box, float bias, WedgeList& kept) {
  kept.clear();
  const PointBox local = grown(box);
  const float* rows[wedgeCoefficients];
  for (int k = 0; k < wedgeCoefficients; ++k) rows[k] = list.coefficients[k].data();
  constexpr int chunk = 256;
  uint8_t touching[chunk], inside[chunk];
  for (int first = 0; first < list.count; first += chunk) {
    const int padded = (list.count - first + wedgeLanes - 1) / wedgeLanes * wedgeLanes;
    const int count = std::min(chunk, padded);
    boxStates(rows, count, &local.centre.x, &local.half.x, bias, touching, inside);
    for (int i = 0; i < count; ++i) {
      if (inside[i]) return BoxState::inside;
      if (touching[i]) kept.append(rows, i, list.id[first + i]);
    }
    for (auto& row : rows) row += chunk;
  }
  kept.pad();
  return kept.empty() ? BoxState::apart : BoxState::touching;
}

uint64_t bitsOf(const uint8_t* bytes) {
  uint64_t mask = 0;
  for (int i = 0; i < 8; ++i) {
    uint64_t eight;
    std::memcpy(&eight, bytes + 8 * i, 8);
    mask |= ((eight * 0x0102040810204080ull) >> 56) << (8 * i);
  }
  return mask;
}

uint64_t wedgeMask(const std::array<float, wedgeCoefficients>& wedge, const float* x,
                   const float* y, const float* z, float bias) {
  uint8_t inside[64];
  insideBytes(wedge.data(), x, y, z, bias, inside);
  return bitsOf(inside);
}

}  // namespace kagefude
