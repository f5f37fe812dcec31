#include "passes/tone/tone.h"

#include "image/parallel.h"
#include "image/real_math.h"

namespace kagefude {

float adjustTone(float tone, const ToneParams& params) {
  const float range = params.white - params.black;
  if (!(range > 0.0f)) return tone >= params.white ? 1.0f : 0.0f;
  const float level = (tone - params.black) / range;
  if (!(level > 0.0f)) return 0.0f;
  if (level >= 1.0f) return 1.0f;
  if (params.gamma == 1.0f) return level;
  const float lifted = powerOf(level, 1.0f / params.gamma);
  return lifted < 1.0f ? lifted : 1.0f;
}

void adjustTone(View<float> tone, const ToneParams& params) {
  parallelRows(tone.height, 64, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < tone.width; ++x) tone(x, y) = adjustTone(tone(x, y), params);
  });
}

void adjustTone(View<float> tone, View<const uint16_t> anchorIndex,
                std::span<const ToneParams> perAnchor) {
  parallelRows(tone.height, 64, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < tone.width; ++x) {
        const size_t index = anchorIndex(x, y);
        if (index > 0 && index <= perAnchor.size())
          tone(x, y) = adjustTone(tone(x, y), perAnchor[index - 1]);
      }
  });
}

}  // namespace kagefude
