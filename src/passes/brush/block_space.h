#pragma once

#include "passes/brush/brush_block.h"
#include "passes/brush/brush_taps.h"

// Where a block's strokes find their direction, for kernels that are written once.
namespace kagefude {

/// The world: positions as they are seen, whose parts are along the object's axes.
struct WorldSpace {
  const float *x, *y, *z;
  const float *across[3], *down[3];
  V3f axis[3];

  WorldSpace(const BrushBlock& block, const ObjectAxes& object)
      : x(block.here.x + 1),
        y(block.here.y + 1),
        z(block.here.z + 1),
        across{block.across.x, block.across.y, block.across.z},
        down{block.down.x, block.down.y, block.down.z},
        axis{object.x, object.y, object.z} {}
  /// The way to pixel i from a centre.
  __attribute__((always_inline)) inline V3f from(const StrokeCentre& centre, int i) const {
    return {x[i] - centre.position.x, y[i] - centre.position.y, z[i] - centre.position.z};
  }
  /// Part of a direction along axis k.
  __attribute__((always_inline)) inline float along(int k, float dx, float dy, float dz) const {
    return dx * axis[k].x + dy * axis[k].y + dz * axis[k].z;
  }
};

/// The object at rest: places along its axes.
struct RestSpace {
  const float *x, *y, *z;
  const float *across[3], *down[3];

  explicit RestSpace(const BrushBlock& block)
      : x(block.place[0]),
        y(block.place[1]),
        z(block.place[2]),
        across{block.placeAcross[0], block.placeAcross[1], block.placeAcross[2]},
        down{block.placeDown[0], block.placeDown[1], block.placeDown[2]} {}
  __attribute__((always_inline)) inline V3f from(const StrokeCentre& centre, int i) const {
    const float step = centre.step, steps = centre.steps;
    return {fromNearest(x[i] - centre.position.x, step, steps),
            fromNearest(y[i] - centre.position.y, step, steps),
            fromNearest(z[i] - centre.position.z, step, steps)};
  }
  __attribute__((always_inline)) inline float along(int k, float dx, float dy, float dz) const {
    return k == 0 ? dx : k == 1 ? dy : dz;
  }
};

/// Part of the direction round the axis v that lies in a surface at q from it with the unit normal
/// n (zero: all of it).
__attribute__((always_inline)) inline V3f directionRound(V3f v, V3f q, float nx, float ny,
                                                         float nz) {
  const float rx = v.y * q.z - v.z * q.y, ry = v.z * q.x - v.x * q.z, rz = v.x * q.y - v.y * q.x;
  const float off = nx * rx + ny * ry + nz * rz;
  return {rx - nx * off, ry - ny * off, rz - nz * off};
}

}  // namespace kagefude
