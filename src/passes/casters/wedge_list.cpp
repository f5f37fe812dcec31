#include "passes/casters/wedge_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/clones.h"

namespace kagefude {
namespace {

/// Rounding of q relative to its size; boxes grow by it before they are tested.
constexpr float slack = 2e-6f;
/// A wedge that holds no point.
constexpr float emptyWedge[wedgeCoefficients] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0,
                                                 0, 1, 0, 0, 0, 1, 0, 0, 0};

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

KAGEFUDE_CLONES void insideBytes(const float* c, const float* x, const float* y, const float* z,
                                 uint8_t* inside) {
  for (int i = 0; i < 64; ++i) {
    const float s0 = c[0] * x[i] + c[1] * y[i] + c[2] * z[i] - c[3];
    const float s1 = c[4] * x[i] + c[5] * y[i] + c[6] * z[i] - c[7];
    const float s2 = c[8] * x[i] + c[9] * y[i] + c[10] * z[i] - c[11];
    const float s3 = c[12] * x[i] + c[13] * y[i] + c[14] * z[i] - c[15];
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
    for (int k = 0; k < wedgeCoefficients; ++k) coefficients[k][i] = emptyWedge[k];
}

std::array<float, wedgeCoefficients> WedgeList::wedge(int index) const {
  std::array<float, wedgeCoefficients> result;
  for (int k = 0; k < wedgeCoefficients; ++k) result[k] = coefficients[k][index];
  return result;
}

BoxVerdict::BoxVerdict(const PointBox& box, float bias) : box_(grown(box)), bias_(bias) {}

void BoxVerdict::look(const float* const* rows, int count) {
  boxStates(rows, count, &box_.centre.x, &box_.half.x, bias_,
            {touches_, holds_, crosses_, holdsCentre_});
}

bool BoxVerdict::add(int i) {
  if (!touches_[i]) return false;
  touching_ = true;
  inside_ |= holds_[i] != 0;
  crossing_ |= crosses_[i] != 0;
  centred_ |= holdsCentre_[i] != 0;
  return true;
}

BoxState BoxVerdict::state() const {
  if (!touching_) return BoxState::apart;
  if (bias_ == undecided) return BoxState::touching;
  if (inside_) return BoxState::inside;
  if (crossing_) return BoxState::touching;
  return centred_ ? BoxState::inside : BoxState::apart;
}

BoxState filterIndices(const WedgeList& list, const PointBox& box, float bias,
                       std::vector<int>& kept) {
  kept.clear();
  const float* rows[wedgeCoefficients];
  for (int k = 0; k < wedgeCoefficients; ++k) rows[k] = list.coefficients[k].data();
  BoxVerdict verdict(box, bias);
  for (int first = 0; first < list.count && !verdict.settled(); first += BoxVerdict::chunk) {
    const int padded = (list.count - first + wedgeLanes - 1) / wedgeLanes * wedgeLanes;
    const int count = std::min(BoxVerdict::chunk, padded);
    verdict.look(rows, count);
    for (int i = 0; i < count; ++i)
      if (verdict.add(i)) kept.push_back(first + i);
    for (auto& row : rows) row += BoxVerdict::chunk;
  }
  return verdict.state();
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
                    const std::array<V3f, 4>& corners) {
  bool inside = true;
  for (int plane = 0; plane < 4; ++plane) {
    const float* c = wedge.data() + 4 * plane;
    int behind = 0;
    for (const V3f& q : corners) behind += c[0] * q.x + c[1] * q.y + c[2] * q.z >= c[3];
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
                   const float* y, const float* z) {
  uint8_t inside[64];
  insideBytes(wedge.data(), x, y, z, inside);
  return bitsOf(inside);
}

}  // namespace kagefude
