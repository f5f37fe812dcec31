#include "passes/depth_map/map_shadow.h"

namespace kagefude {

// A texel at (x, y) and depth S stands S·(slope · (1, x, y)) + base · (1, x, y) over the tangent
// plane: with P the receiver, V its depth, n its normal, on a perspective map
// n · (S·(Px/V + du, Py/V - dv, -1) - P), on an orthographic one n · (du, -dv, V - S).
MapShadow::MapShadow(View<const float> depth, const DepthPyramid& pyramid, bool perspective,
                     const MapPoint& receiver, float bias, float extent)
    : depth_(depth),
      pyramid_(pyramid),
      perspective_(perspective),
      r_(receiver),
      least_(bias / receiver.texelsPerUnit + 2e-6f * receiver.depth),
      extent_(extent) {
  const V3f& n = r_.normal;
  const float du = n.x / r_.texelsPerSlope, dv = -n.y / r_.texelsPerSlope;
  const float aside = -du * r_.u - dv * r_.v;
  if (perspective_) {
    slope_ = V3f((n.x * r_.place.x + n.y * r_.place.y) / r_.depth - n.z + aside, du, dv);
    base_ = V3f(-n.dot(r_.place), 0, 0);
  } else {
    slope_ = V3f(-n.z, 0, 0);
    base_ = V3f(n.z * r_.depth + aside, du, dv);
  }
}

/// Texels round the receiver that the light's disc covers through a blocker of that depth; the
/// farthest where a mask's place, beside the receiver, leaves that unknown.
float MapShadow::reachOf(float blocker) const {
  const float between = high(0, r_.depth - blocker);
  const float size =
      extent_ * between * r_.texelsPerUnit /
      (low(r_.perRadius.x, r_.perRadius.y) * (perspective_ ? high(blocker, 1e-6f) : 1));
  return 1 + (size < farthest ? size : farthest);
}

float MapShadow::nearestWithin(float reach) const {
  const DepthPyramid::Level level = pyramid_.levelFor(static_cast<int>(2 * reach) + 3);
  const auto column = [&](float u) {
    return std::clamp(static_cast<int>(std::floor(u)), 0, depth_.width - 1) >> level.shift;
  };
  const auto row = [&](float v) {
    return std::clamp(static_cast<int>(std::floor(v)), 0, depth_.height - 1) >> level.shift;
  };
  const int x0 = column(r_.u - reach), x1 = column(r_.u + reach);
  const int y0 = row(r_.v - reach), y1 = row(r_.v + reach);
  const View<const float>& near = level.nearest;
  return low(low(near(x0, y0), near(x1, y0)), low(near(x0, y1), near(x1, y1)));
}

/// Half the side of the window that holds all that can hide the light, texels.
float MapShadow::windowOf() const {
  float reach = reachOf(pyramid_.whole().nearest);
  for (int narrowing = 0; narrowing < 3; ++narrowing)
    reach = low(reach, reachOf(nearestWithin(reach)));
  return reach;
}

}  // namespace kagefude
