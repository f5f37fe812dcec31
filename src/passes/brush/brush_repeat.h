#pragma once

#include <cmath>

#include "passes/brush/brush_frame.h"

namespace kagefude {

/// Where a point lies among the rings of equal repeat count.
struct BrushRepeat {
  float distance = 0;  ///< Pd, world units from the axis
  float count = 0;     ///< T, a whole number
  float fraction = 0;  ///< s, 0..1 from this ring's inner to its outer edge
  float next = 0;      ///< t, share of the next ring's strokes
};

/// Pd, T = floor(Pd / Md) (002 eq. 3.7), s = Pd / Md - T (3.8), and the share t of ring T + 1:
/// 0 for s < 1 - α, else (s - 1) / α + 1 (3.9), α = blendWidth in (0, 1]; α = 0 never blends.
/// mappingDistance must be positive.
inline BrushRepeat brushRepeat(float distance, float mappingDistance, float blendWidth) {
  BrushRepeat repeat;
  repeat.distance = distance;
  const float rings = distance / mappingDistance;
  repeat.count = std::floor(rings);
  repeat.fraction = rings - repeat.count;
  if (blendWidth > 0.0f && repeat.fraction >= 1.0f - blendWidth)
    repeat.next = (repeat.fraction - 1.0f) / blendWidth + 1.0f;
  return repeat;
}

/// Distance of p from the axis through `referencePoint`.
inline float axisDistance(const BrushFrame& frame, const V3f& referencePoint, const V3f& p) {
  const V3f q = p - referencePoint;
  const float a = frame.l1.dot(q), b = frame.l2.dot(q);
  return std::sqrt(a * a + b * b);
}

}  // namespace kagefude
