#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// Triangles side by side in one block: what one vector instruction looks at.
inline constexpr int wedgeLanes = 8;

/// Box by centre and half extents, in coordinates relative to the camera's eye.
struct PointBox {
  V3f centre{0, 0, 0}, half{0, 0, 0};

  static PointBox around(const V3f& low, const V3f& high) {
    return {(low + high) * 0.5f, (high - low) * 0.5f};
  }
  bool contains(const PointBox& inner) const;
};

/// A triangle's shadow volume as four half-spaces n·q - d >= 0: three sides through the light and
/// an edge each, and the triangle's own plane, positive behind it. Coefficient 4*plane + {0,1,2}
/// is n, 4*plane + 3 is d. Planes 0-2 are the sides; plane 3 has a unit normal. Edges that two
/// triangles share give coefficients that differ in sign only, bit for bit, so shadows of
/// neighbours leave no gap. Triangles seen edge-on, and padding, hold no point.
/// Coefficients 16-18 say whether the sides are edges of the caster's shadow: 0 where no other
/// triangle carries the shadow on (an open edge, a silhouette), large where one does.
inline constexpr int wedgeCoefficients = 19;

/// Wedges side by side, coefficient by coefficient, padded to whole vectors with empty ones.
struct WedgeList {
  std::array<std::vector<float>, wedgeCoefficients> coefficients;
  std::vector<uint32_t> id;
  int count = 0;

  void clear() { count = 0; }
  bool empty() const { return count == 0; }
  void reserve(int wedges);
  void append(const float* const* source, int lane, uint32_t sourceId);
  /// Fills up the last vector; call it after the last append.
  void pad();
  std::array<float, wedgeCoefficients> wedge(int index) const;
};

/// The bias that asks for a list only.
inline constexpr float undecided = 1e30f;

enum class BoxState : uint8_t { apart, touching, inside };

/// What is known of many wedges and one box, gathered into one verdict.
class BoxVerdict {
 public:
  /// `bias` as for ShadowWedges::gather; the box is relative to the apex.
  BoxVerdict(const PointBox& box, float bias);

  /// Looks at `count` wedges, at most chunk and a multiple of wedgeLanes, given row by row.
  void look(const float* const* rows, int count);
  /// Takes wedge i of those last looked at into account; true when it may hold a point of the box.
  bool add(int i);
  /// Whether more wedges cannot change the state.
  bool settled() const { return inside_; }
  BoxState state() const;

  static constexpr int chunk = 256;

 private:
  PointBox box_;
  float bias_;
  bool touching_ = false, inside_ = false, crossing_ = false, centred_ = false;
  alignas(64) uint8_t touches_[chunk], holds_[chunk], crosses_[chunk], holdsCentre_[chunk];
};

/// Keeps in `kept` the wedges of `list` that may hold a point of the box, and judges the box as
/// ShadowWedges::gather does. `box` is relative to the apex.
BoxState filterWedges(const WedgeList& list, const PointBox& box, float bias, WedgeList& kept);

/// As above, but gives the indices of the kept wedges, for short lists.
BoxState filterIndices(const WedgeList& list, const PointBox& box, float bias,
                       std::vector<int>& kept);

/// How a flat patch with four corners (relative to the apex) lies to one wedge.
BoxState patchState(const std::array<float, wedgeCoefficients>& wedge,
                    const std::array<V3f, 4>& corners);

/// One bit for each of 64 points: set where q lies in the wedge. NaN is outside.
uint64_t wedgeMask(const std::array<float, wedgeCoefficients>& wedge, const float* x,
                   const float* y, const float* z);

/// Bit i is set where bytes[i] is not 0; bytes are 0 or 1.
uint64_t bitsOf(const uint8_t* bytes);

}  // namespace kagefude
