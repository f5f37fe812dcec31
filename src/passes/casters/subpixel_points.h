#pragma once

#include <cstdint>

#include "passes/casters/wedge_list.h"

namespace kagefude {

/// The surface at the 8x8 sub-pixels of one pixel, row by row; sub-pixel (i, j) has its place at
/// ((i + 0.5)/8, (j + 0.5)/8). Coordinates are relative to the camera's eye.
struct SubpixelPoints {
  alignas(64) float x[64];
  alignas(64) float y[64];
  alignas(64) float z[64];
  uint32_t id[64];
  uint64_t present = 0;     ///< sub-pixels that show a surface
  uint64_t facingAway = 0;  ///< of them, those on the dark side of a caster's triangle

  void place(int k, const V3f& point) {
    x[k] = point.x;
    y[k] = point.y;
    z[k] = point.z;
  }
  /// Box round the points of a group that is not empty.
  PointBox box(uint64_t group) const;
  /// The present points before the widest gap in distance from the eye, when it is a third of
  /// their range or more, as between two surfaces; else all present points.
  uint64_t beforeGap() const;
};

}  // namespace kagefude
