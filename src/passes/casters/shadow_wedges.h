#pragma once

#include <array>
#include <vector>

#include "passes/casters/caster_set.h"
#include "passes/casters/wedge_list.h"

namespace kagefude {

/// Where light (or sight) comes from: a place, or for a sun a direction, the way light travels.
struct LightPlace {
  bool directional = false;
  V3d position{0, 0, 0};
  V3d direction{0, 0, -1};
};

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

}  // namespace kagefude
