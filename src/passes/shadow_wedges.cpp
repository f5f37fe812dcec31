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

/// Per wedge: whether it may reach the box, holds the box, has an edge of the shadow or its own
/// plane in the box, and holds the box's centre.
struct BoxFlags {
  uint8_t *touching, *inside, *crossing, *centred;
};

KAGEFUDE_CLONES void boxStates(const float* const* c, int count, const float* centre,
                               const float* half, float bias, const BoxFlags& flags) {
  uint8_t* const touching = flags.touching;
  uint8_t* const inside = flags.inside;
  uint8_t* const crossing = flags.crossing;
  uint8_t* const centred = flags.centred;
  for (int i = 0; i < count; ++i) {
    float most = 1e30f, least = 1e30f, edge = 1e30f, middles = 1e30f;
    for (int plane = 0; plane < 4; ++plane) {
      const float nx = c[4 * plane][i], ny = c[4 * plane + 1][i], nz = c[4 * plane + 2][i];
      const float middle = nx * centre[0] + ny * centre[1] + nz * centre[2] - c[4 * plane + 3][i];
      const float reach =
          std::fabs(nx) * half[0] + std::fabs(ny) * half[1] + std::fabs(nz) * half[2];
      const float margin = plane == 3 ? bias : 0.0f;
      const float high = middle + reach, low = middle - reach - margin;
      const float open = plane == 3 ? low : low + c[16 + (plane & 3) % 3][i];
      most = high < most ? high : most;
      least = low < least ? low : least;
      edge = open < edge ? open : edge;
      middles = middle - margin < middles ? middle - margin : middles;
    }
    touching[i] = most >= 0.0f ? 1 : 0;
    inside[i] = least >= 0.0f ? 1 : 0;
    crossing[i] = edge < 0.0f ? 1 : 0;
    centred[i] = middles >= 0.0f ? 1 : 0;
  }
}

/// Gathers what boxStates says of many wedges into one verdict.
struct Verdict {
  bool inside = false, crossing = false, centred = false, touching = false;

  BoxState state(float bias) const {
    if (!touching) return BoxState::apart;
    if (bias == undecided) return BoxState::touching;
    if (inside) return BoxState::inside;
    if (crossing) return BoxState::touching;
    return centred ? BoxState::inside : BoxState::apart;
  }
};

constexpr int chunk = 256;

struct ChunkFlags {
  alignas(64) uint8_t touching[chunk], inside[chunk], crossing[chunk], centred[chunk];
  BoxFlags flags() { return {touching, inside, crossing, centred}; }

  /// Adds wedge i to the verdict; true when it reaches the box.
  bool add(int i, Verdict& verdict) const {
    if (!touching[i]) return false;
    verdict.touching = true;
    verdict.inside |= inside[i] != 0;
    verdict.crossing |= crossing[i] != 0;
    verdict.centred |= centred[i] != 0;
    return true;
  }
};

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
  local = grown(local);
  const Shaft shaft = Shaft::toLight(local, directional_, direction_);
  Verdict verdict;
  ChunkFlags flags;
  descend([&](const V3f& low, const V3f& high) { return shaft.mayTouch(low, high); },
          [&](const float* const* rows, const uint32_t* id) {
            boxStates(rows, wedgeLanes, &local.centre.x, &local.half.x, bias, flags.flags());
            for (int lane = 0; lane < wedgeLanes; ++lane)
              if (flags.add(lane, verdict)) found.append(rows, lane, id[lane]);
            return !verdict.inside;
          });
  found.pad();
  return verdict.state(bias);
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

BoxState filterIndices(const WedgeList& list, const PointBox& box, float bias,
                       std::vector<int>& kept) {
  kept.clear();
  const PointBox local = grown(box);
  const float* rows[wedgeCoefficients];
  for (int k = 0; k < wedgeCoefficients; ++k) rows[k] = list.coefficients[k].data();
  Verdict verdict;
  ChunkFlags flags;
  for (int first = 0; first < list.count && !verdict.inside; first += chunk) {
    const int padded = (list.count - first + wedgeLanes - 1) / wedgeLanes * wedgeLanes;
    const int count = std::min(chunk, padded);
    boxStates(rows, count, &local.centre.x, &local.half.x, bias, flags.flags());
    for (int i = 0; i < count; ++i)
      if (flags.add(i, verdict)) kept.push_back(first + i);
    for (auto& row : rows) row += chunk;
  }
  return verdict.state(bias);
}

BoxState filterWedges(const WedgeList& list, const PointBox& box, float bias, WedgeList& kept) {
  thread_local std::vector<int> indices;
  const BoxState state = filterIndices(list, box, bias, indices);
  kept.clear();
  if (state != BoxState::touching) return state;
  const float* rows[wedgeCoefficients];
  for (int k = 0; k < wedgeCoefficients; ++k) rows[k] = list.coefficients[k].data();
  for (int i : indices) kept.append(rows, i, list.id[i]);
  kept.pad();
  return state;
}

BoxState patchState(const std::array<float, wedgeCoefficients>& wedge,
                    const std::array<V3f, 4>& corners, float bias) {
  bool inside = true;
  for (int plane = 0; plane < 4; ++plane) {
    const float* c = wedge.data() + 4 * plane;
    const float offset = plane == 3 ? c[3] + bias : c[3];
    int behind = 0;
    for (const V3f& q : corners) behind += c[0] * q.x + c[1] * q.y + c[2] * q.z >= offset;
    if (behind == 0) return BoxState::apart;
    inside &= behind == 4;
  }
  return inside ? BoxState::inside : BoxState::touching;
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
