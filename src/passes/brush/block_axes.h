#pragma once

#include "passes/brush/brush_block.h"

// The directions along which a block's places are counted, for kernels that are written once.
namespace kagefude {

/// The object's own, the same at every pixel.
struct SameAxes {
  V3f axis[3];

  explicit SameAxes(const ObjectAxes& object) : axis{object.x, object.y, object.z} {}
  /// Part along axis k of a direction at pixel i.
  __attribute__((always_inline)) inline float along(int k, int, float x, float y, float z) const {
    return x * axis[k].x + y * axis[k].y + z * axis[k].z;
  }
};

/// Those of a block at rest, which differ from pixel to pixel.
struct PixelAxes {
  const float *x[3], *y[3], *z[3];

  explicit PixelAxes(const BrushBlock& block)
      : x{block.axisX[0], block.axisX[1], block.axisX[2]},
        y{block.axisY[0], block.axisY[1], block.axisY[2]},
        z{block.axisZ[0], block.axisZ[1], block.axisZ[2]} {}
  __attribute__((always_inline)) inline float along(int k, int i, float dx, float dy,
                                                    float dz) const {
    return dx * x[k][i] + dy * y[k][i] + dz * z[k][i];
  }
};

}  // namespace kagefude
