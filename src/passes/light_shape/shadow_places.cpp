#include "passes/light_shape/shadow_places.h"

#include <algorithm>
#include <cmath>

#include "image/real_math.h"
#include "passes/light_shape/light_mesh.h"

namespace kagefude {
namespace {

constexpr float goldenTurn = 0.38196601125f;

}  // namespace

ShadowPlaces placesBetween(std::span<const V2f> masks, int count, float radius) {
  const LightMesh mesh(masks);
  ShadowPlaces result;
  result.count = count;
  for (int i = 0; i < count; ++i) {
    const float r = radius * std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
    const float turn = static_cast<float>(i) * goldenTurn;
    const SinCos angle = sinCosTurns(turn - std::floor(turn));
    const V2f p(r * angle.cos, r * angle.sin);
    const LightMesh::Blend blend = mesh.blendAt(p);
    for (int t = 0; t < 3; ++t) {
      const V2f offset = p - masks[blend.mask[t]];
      result.x[t][i] = offset.x;
      result.y[t][i] = offset.y;
      // Beyond the rim of the mesh the nearest masks, not their opposites.
      result.weight[t][i] = std::max(0.0f, blend.weight[t]);
      result.mask[t][i] = static_cast<int32_t>(blend.mask[t]);
      result.reach = std::max(result.reach, offset.length());
    }
  }
  return result;
}

}  // namespace kagefude
