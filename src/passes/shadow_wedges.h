#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passes/caster_set.h"

namespace kagefude {

/// Where light (or sight) comes from: a place, or for a sun a direction, the way light travels.
struct LightPlace {
  bool directional = false;
  V3d position{0, 0, 0};
  V3d direction{0, 0, -1};
};

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

/// The shadow volumes of all casters for one light, or, with the camera in the light's stead, what
/// hides what. Built in linear time; about 70 bytes a triangle.
class ShadowWedges {
 public:
  /// `eye` is what boxes and points are relative to (CameraRays::eye). The light may lie anywhere,
  /// also on a caster.
  ShadowWedges(const CasterSet& casters, const LightPlace& light, const V3d& eye);

  /// q = point - apex() are the coordinates of the half-spaces; zero for a directional light.
  const V3f& apex() const { return apex_; }
  const CasterSet& casters() const { return casters_; }

  /// Writes to `found` every wedge that may hold a point of the box. Unless bias is `undecided`,
  /// returns inside or apart when the whole box is in shadow or lit by more than `bias` (world
  /// units), whatever `found` holds: when one wedge holds the box, or when no edge of a shadow and
  /// no plane of a wedge in reach passes through it, so that its centre speaks for all of it.
  BoxState gather(const PointBox& box, float bias, WedgeList& found) const;

  /// For the camera's wedges: every triangle that may be seen in the picture's rectangle, whose
  /// four corner rays (directions, or origins of an orthographic camera) go round it.
  void gatherSeen(const std::array<V3f, 4>& corners, WedgeList& found) const;

 private:
  struct Block {
    float c[wedgeCoefficients][wedgeLanes];
    uint32_t id[wedgeLanes];
  };
  const CasterSet& casters_;
  V3f apex_;
  V3f direction_;
  bool directional_;
  V3d eye_;
  std::vector<Block> blocks_;

  template <class NodeTest, class Leaf>
  void descend(const NodeTest& test, const Leaf& leaf) const;
};

/// Keeps in `kept` the wedges of `list` that may hold a point of the box, and judges the box as
/// ShadowWedges::gather does. `box` is relative to the apex.
BoxState filterWedges(const WedgeList& list, const PointBox& box, float bias, WedgeList& kept);

/// As above, but gives the indices of the kept wedges, for short lists.
BoxState filterIndices(const WedgeList& list, const PointBox& box, float bias,
                       std::vector<int>& kept);

/// How a flat patch with four corners (relative to the apex) lies to one wedge.
BoxState patchState(const std::array<float, wedgeCoefficients>& wedge,
                    const std::array<V3f, 4>& corners, float bias);

/// One bit for each of 64 points: set where q lies in the wedge, more than bias behind its
/// triangle. NaN is outside.
uint64_t wedgeMask(const std::array<float, wedgeCoefficients>& wedge, const float* x,
                   const float* y, const float* z, float bias);

/// Bit i is set where bytes[i] is not 0; bytes are 0 or 1.
uint64_t bitsOf(const uint8_t* bytes);

}  // namespace kagefude
