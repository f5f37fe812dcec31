#include "passes/tone/tint.h"

namespace kagefude {
namespace {

/// `colour` times `filter`, as bright as it was.
V3f turned(const V3f& colour, const V3f& filter) {
  // A filter that lets nothing of the colour through cannot be made up for.
  constexpr float mostGain = 4;
  const V3f through(colour.x * filter.x, colour.y * filter.y, colour.z * filter.z);
  const float before = luminanceOf(colour), after = luminanceOf(through);
  if (!(after > 0.0f)) return colour;
  const float gain = before / after;
  return through * (gain < mostGain ? gain : mostGain);
}

}  // namespace

V3f tinted(const V3f& colour, const V3f& light, float tone, const TintParams& params) {
  V3f result = colour;
  if (params.light > 0.0f) {
    const V3f white(1.0f);
    result = turned(result, white + (light - white) * params.light);
  }
  if (!params.shadow.empty() && params.shadowStrength > 0.0f) {
    const V3f shadow(params.shadow[0], params.shadow[1], params.shadow[2]);
    const float own = luminanceOf(shadow);
    const float known = tone > 0.0f ? (tone < 1.0f ? tone : 1.0f) : 0.0f;
    const float share = (1.0f - known) * params.shadowStrength;
    if (own > 0.0f) result = turned(result, V3f(1.0f) + (shadow / own - V3f(1.0f)) * share);
  }
  return result;
}

}  // namespace kagefude
