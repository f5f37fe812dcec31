#pragma once

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include "image/plane.h"

namespace kagefude {

using V2f = Imath::V2f;
using V3f = Imath::V3f;
using V3d = Imath::V3d;
using V4d = Imath::V4d;

/// 4x4 matrix in column-vector convention (p' = M p), unlike Imath's row vectors; named by what it
/// maps, `cameraFromWorld`, so that a product of two reads right.
struct Transform {
  double m[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

  /// Homogeneous image of the point p; w is 1 for affine maps.
  V4d homogeneous(const V3d& p) const;
  /// Image of the point p after division by w. Undefined where w is 0.
  V3d point(const V3d& p) const;
  /// Image of a direction under the linear part, not normalised.
  V3d direction(const V3d& d) const;
  /// The inverse; a singular matrix gives the identity.
  Transform inverse() const;
};

/// a after b: maps what b maps, then a.
Transform operator*(const Transform& a, const Transform& b);

/// Three planes of equal size that hold one vector a pixel.
struct Vec3View {
  View<const float> x, y, z;

  V3f operator()(int column, int row) const {
    return {x(column, row), y(column, row), z(column, row)};
  }
  int width() const { return x.width; }
  int height() const { return x.height; }
  bool empty() const { return x.empty(); }
};

struct Vec3Plane {
  Floats x, y, z;

  Vec3Plane() = default;
  Vec3Plane(int width, int height) : x(width, height), y(width, height), z(width, height) {}
  Vec3View view() const { return {x, y, z}; }
  operator Vec3View() const { return view(); }
  void set(int column, int row, const V3f& v) {
    x(column, row) = v.x;
    y(column, row) = v.y;
    z(column, row) = v.z;
  }
  bool empty() const { return x.empty(); }
};

}  // namespace kagefude
