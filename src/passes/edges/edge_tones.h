#pragma once

#include <cmath>

#include "passes/edges/behind_paint.h"
#include "passes/strip/strip.h"

namespace kagefude {

/// From 0 to 1 as t goes, without corners.
inline float easedIn(float t) {
  const float c = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  return c * c * (3.0f - 2.0f * c);
}

inline float paintLuminance(const Rgba& colour) {
  return 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
}

/// How bright a colour over nothing looks, about 0..1.
inline float paintBrightness(const Rgba& colour) {
  const float luminance = paintLuminance(colour);
  return std::sqrt(luminance > 0.0f ? luminance : 0.0f);
}

inline Rgba paintAt(const ColourViews& planes, int x, int y) {
  return Rgba{planes.r(x, y), planes.g(x, y), planes.b(x, y), planes.a(x, y)};
}

inline Rgba paintAt(const PaintViews& planes, int x, int y) {
  return Rgba{planes.r(x, y), planes.g(x, y), planes.b(x, y), planes.a(x, y)};
}

inline void setPaint(const PaintViews& planes, int x, int y, const Rgba& colour) {
  planes.r(x, y) = colour[0];
  planes.g(x, y) = colour[1];
  planes.b(x, y) = colour[2];
  planes.a(x, y) = colour[3];
}

}  // namespace kagefude
