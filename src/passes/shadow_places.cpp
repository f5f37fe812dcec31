#include "passes/shadow_places.h"

#include <algorithm>
#include <cmath>

#include "image/real_math.h"

namespace kagefude {
namespace {

constexpr float goldenTurn = 0.38196601125f;

}  // namespace

ShadowPlaces placesBetween(std::span<const V2f> masks, int count, float radius) {
  const int ring = static_cast<int>(masks.size()) - 1;
  ShadowPlaces result;
  result.count = count;
  for (int i = 0; i < count; ++i) {
    const float r = radius * std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
    const float turn = static_cast<float>(i) * goldenTurn;
    const SinCos angle = sinCosTurns(turn - std::floor(turn));
    const V2f p(r * angle.cos, r * angle.sin);
    const int wedge =
        std::min(static_cast<int>(turnsOf(p.y, p.x) * static_cast<float>(ring)), ring - 1);
    const int a = 1 + wedge, b = 1 + (wedge + 1) % ring;
    const V2f &pa = masks[static_cast<size_t>(a)], &pb = masks[static_cast<size_t>(b)];
    const float det = pa.x * pb.y - pa.y * pb.x;
    const float wa = std::max(0.0f, (p.x * pb.y - p.y * pb.x) / det);
    const float wb = std::max(0.0f, (pa.x * p.y - pa.y * p.x) / det);
    const V2f offset[3] = {p - masks[0], p - pa, p - pb};
    const float weight[3] = {std::max(0.0f, 1.0f - wa - wb), wa, wb};
    const int mask[3] = {0, a, b};
    for (int t = 0; t < 3; ++t) {
      result.x[t][i] = offset[t].x;
      result.y[t][i] = offset[t].y;
      result.weight[t][i] = weight[t];
      result.mask[t][i] = mask[t];
      result.reach = std::max(result.reach, offset[t].length());
    }
  }
  return result;
}

}  // namespace kagefude
