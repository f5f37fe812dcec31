#include "passes/light_shape/shadow_places.h"

#include <algorithm>
#include <cmath>

#include "image/real_math.h"
#include "passes/light_shape/light_mesh.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

constexpr float goldenTurn = 0.38196601125f;
V2f placeOnDisc(int i, int count) {
  const float r = std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
  const float turn = static_cast<float>(i) * goldenTurn;
  const SinCos angle = sinCosTurns(turn - std::floor(turn));
  return V2f(r * angle.cos, r * angle.sin);
}

/// Even steps along u, golden ones along v; the places lie mirrored about the centre, so that their
/// mean is the light's.
V2f placeOnRectangle(int i, int count) {
  const float n = static_cast<float>(count);
  const float t = 0.5f + (static_cast<float>(i) - 0.5f * (n - 1)) * goldenTurn;
  return V2f((2.0f * static_cast<float>(i) + 1.0f) / n - 1.0f, 2.0f * (t - std::floor(t)) - 1.0f);
}

}  // namespace

ShadowPlaces placesBetween(std::span<const V2f> masks, int count, float radius) {
  const LightMesh mesh(masks);
  const bool rectangle = placesOnRectangle(masks);
  ShadowPlaces result;
  result.count = count;
  for (int i = 0; i < count; ++i) {
    const V2f p = (rectangle ? placeOnRectangle(i, count) : placeOnDisc(i, count)) * radius;
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
