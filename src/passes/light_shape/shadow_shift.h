#pragma once

#include "passes/light_shape/light_shape.h"

namespace kagefude {

/// How a shadow moves on the picture when the light does, up to one length: pixels for one unit of
/// place along u and along v, the longest shift of the unit circle being 1.
struct ShadowShift {
  float ux = 0, uy = 0, vx = 0, vy = 0;
  float trust = 0;  ///< less where light grazes the surface, which may bend away
  bool valid = false;
};

/// The shift on the tangent plane of the pixel's surface, seen on the picture by the positions of
/// its neighbours of the same label. Not valid where light grazes or leaves the surface, and where
/// the pixel has no neighbour to tell its place by.
ShadowShift shadowShiftAt(int x, int y, View<const uint32_t> labels, Vec3View position,
                          Vec3View normal, const LightGeometry& geometry);

}  // namespace kagefude
