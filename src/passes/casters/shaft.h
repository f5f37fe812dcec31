#pragma once

#include <array>

#include "passes/casters/shadow_wedges.h"

namespace kagefude {

/// A convex region of space for culling boxes: everything between a box and the light, or what a
/// rectangle of the picture can see. Half-spaces n·p >= d and a bounding box, in one frame of
/// coordinates relative to the apex.
class Shaft {
 public:
  /// Between a light at the origin (or far off against `direction` when directional) and a box.
  /// Haines & Wallace's shaft: the box round both, and per pair of axes the two tangents.
  static Shaft toLight(const PointBox& box, bool directional, const V3f& direction);
  /// Inside a pyramid through the origin, or a prism along `direction`, round four corners in
  /// order.
  static Shaft ofSight(const std::array<V3f, 4>& corners, bool directional, const V3f& direction);

  /// False only when no point of the box is in the shaft.
  bool mayTouch(const V3f& low, const V3f& high) const;

 private:
  void addPlane(const V3f& normal, float offset);
  void addTangents(int u, int v, const PointBox& box);
  void addParallels(int u, int v, const PointBox& box, const V3f& direction);

  V3f low_, high_;
  std::array<V3f, 8> normals_;
  std::array<float, 8> offsets_;
  int count_ = 0;
};

}  // namespace kagefude
