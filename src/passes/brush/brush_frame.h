#pragma once

#include "passes/tone/light.h"

namespace kagefude {

/// The stroke frame of one reference point: `axis` from the light through it (V), and two unit
/// vectors perpendicular to V and to each other, from which the stroke angle is counted.
struct BrushFrame {
  V3f axis{0, 0, -1};
  V3f l1{1, 0, 0};
  V3f l2{0, 1, 0};
};

/// Axes of an object without its scale: where they point in the world. Right-handed, orthonormal.
struct ObjectAxes {
  V3f origin{0, 0, 0};
  V3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

/// The axes of worldFromObject, made orthonormal: x first, then y, z from the two. Scale and shear
/// are dropped, a mirrored object gets right-handed axes. A collapsed axis is replaced by any
/// perpendicular one.
ObjectAxes objectAxes(const Transform& worldFromObject);

/// V = (G - L) / |G - L| (002 eq. 3.2); for a sun its direction. Light and reference point at the
/// same place: the light's direction, or -Z.
V3f lightAxis(const Light& light, const V3f& referencePoint);

/// The seed's frame (002 eq. 3.3, 3.4, mended): L1, L2 are world X and Y under Rx(θx) Ry(θy). The
/// seed takes θy from V's projection on the XZ plane, which does not carry Z to V; here
/// θy = asin Vx, which does. θx as the seed has it, from the projection on the YZ plane.
/// Singular, with a jump of up to half a turn, where V passes through ±X; there θx = 0.
BrushFrame seedFrame(const V3f& axis);

/// **[ours]** The frame that turns least: the rotation without twist that carries the object's -Z
/// ("light from above") to V, applied to the object's X and -Y. It depends on this frame's light
/// and object alone, turns with the object, and is smooth in V everywhere except at V = object +Z
/// (light from straight below), which no such frame can avoid: near it the frame spins by twice
/// the angle that V runs round the pole; exactly there it is (X, Y). `held` strokes do not use it.
BrushFrame turningFrame(const V3f& axis, const ObjectAxes& object);

}  // namespace kagefude
