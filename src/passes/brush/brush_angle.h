#pragma once

#include "image/real_math.h"
#include "passes/brush/brush_frame.h"

namespace kagefude {

/// Stroke angle W of the surface point p about the axis through `referencePoint`, in turns, [0, 1):
/// W = atan2(L1·Q, L2·Q) / 2π mod 1 with Q = P - G (002 eq. 3.5, 3.6). *Mended*: the seed tests the
/// sign of the wrong product, jumps in every quadrant, and sets arctan to 0 where L2·Q = 0. Its
/// normalisation of Q is dropped: it changes nothing. On the axis itself W = 0.
inline float brushAngle(const BrushFrame& frame, const V3f& referencePoint, const V3f& p) {
  const V3f q = p - referencePoint;
  return turnsOf(frame.l1.dot(q), frame.l2.dot(q));
}

}  // namespace kagefude
