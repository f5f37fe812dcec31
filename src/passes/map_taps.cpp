#include "passes/map_taps.h"

#include <cmath>

namespace kagefude {

std::vector<V2f> spiralPoints(int n) {
  constexpr float goldenTurn = 0.38196601125f;
  std::vector<V2f> points;
  for (int i = 0; i < n; ++i) {
    const float r = std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(n));
    const SinCos turn = sinCosTurns(static_cast<float>(i) * goldenTurn);
    points.emplace_back(r * turn.cos, r * turn.sin);
  }
  return points;
}

float pixelTurn(int x, int y, int seed) {
  uint32_t h = static_cast<uint32_t>(x) * 0x9e3779b1u + static_cast<uint32_t>(y) * 0x85ebca77u +
               static_cast<uint32_t>(seed) * 0xc2b2ae3du;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  h ^= h >> 16;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

TapCount countTaps(View<const float> depth, const MapReceiver& r, const std::vector<V2f>& points,
                   SinCos turn, const TapTest& test) {
  TapCount count;
  for (const V2f& p : points) {
    const float tu = std::floor(r.u + test.radius * (p.x * turn.cos - p.y * turn.sin));
    const float tv = std::floor(r.v + test.radius * (p.x * turn.sin + p.y * turn.cos));
    const bool inside = tu >= 0 && tv >= 0 && tu < static_cast<float>(depth.width) &&
                        tv < static_cast<float>(depth.height);
    if (!inside) {
      ++count.lit;
      continue;
    }
    const float plane = r.planeDepth(tu + 0.5f - r.u, tv + 0.5f - r.v, test.slopeBias);
    const float away = std::fabs(tu + 0.5f - r.u) + std::fabs(tv + 0.5f - r.v);
    const float allowed = test.bias + away * test.spreadBias / r.texelsPerUnit;
    const float stored = depth(static_cast<int>(tu), static_cast<int>(tv));
    if (stored < plane - allowed) {
      ++count.blocked;
      count.blockerDepth += stored;
    } else {
      ++count.lit;
    }
  }
  return count;
}

}  // namespace kagefude
