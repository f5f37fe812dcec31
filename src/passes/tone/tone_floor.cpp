#include "passes/tone/tone_floor.h"

#include <algorithm>

#include "image/parallel.h"

namespace kagefude {

float worldShare(const ToneParams& params, float world) {
  const float added = params.world * world;
  return added > 0.0f ? added / (1.0f + added) : 0.0f;
}

void raiseTone(View<float> tone, View<const uint16_t> anchorIndex,
               std::span<const ToneParams> perAnchor, const ToneFloor& floor) {
  const bool glows = !floor.emission.empty();
  if (std::none_of(perAnchor.begin(), perAnchor.end(), [&](const ToneParams& params) {
        return worldShare(params, floor.world) > 0.0f || (glows && params.emission > 0.0f);
      }))
    return;
  parallelRows(tone.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < tone.width; ++x) {
        const uint16_t anchor = anchorIndex(x, y);
        if (anchor == 0 || anchor > perAnchor.size()) continue;
        const ToneParams& params = perAnchor[anchor - 1u];
        const float glow = glows ? params.emission * floor.emissionUnit * floor.emission(x, y) : 0;
        const float share = worldShare(params, floor.world);
        const float own = tone(x, y) + (glow > 0.0f ? glow : 0.0f);
        const float raised = share + (1.0f - share) * own;
        tone(x, y) = raised > 0.0f ? (raised < 1.0f ? raised : 1.0f) : 0.0f;
      }
  });
}

}  // namespace kagefude
