#include "passes/tone/merge.h"

#include "image/parallel.h"

namespace kagefude {
namespace {

float clampedUnit(float value) { return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f; }

template <class Combine>
void forEachPair(View<const float> a, View<const float> b, View<float> out, Combine combine) {
  parallelRows(out.height, 64, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const float *pa = a.row(y), *pb = b.row(y);
      float* po = out.row(y);
      for (int x = 0; x < out.width; ++x) po[x] = clampedUnit(combine(pa[x], pb[x]));
    }
  });
}

}  // namespace

void mergeTone(View<const float> visibility, View<const float> shade, const MergeParams& params,
               View<float> tone) {
  switch (params.mode) {
    case MergeParams::Mode::subtract:
      return forEachPair(visibility, shade, tone, [](float a, float b) { return a + b - 1.0f; });
    case MergeParams::Mode::product:
      return forEachPair(visibility, shade, tone, [](float a, float b) { return a * b; });
    case MergeParams::Mode::minimum:
      // The zero term carries a NaN of either into the result, where it becomes 0.
      return forEachPair(visibility, shade, tone,
                         [](float a, float b) { return (a < b ? a : b) + 0.0f * (a + b); });
  }
}

void combineTones(std::span<const View<const float>> perLight, std::span<const float> weights,
                  const MergeParams& params, View<float> tone) {
  parallelRows(tone.height, 64, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < tone.width; ++x) {
        float result = 0.0f;
        for (size_t light = 0; light < perLight.size(); ++light) {
          const float share = weights[light] * perLight[light](x, y);
          const float part = share > 0.0f ? share : 0.0f;
          if (params.lights == MergeParams::Lights::sum)
            result += part;
          else if (params.lights == MergeParams::Lights::maximum)
            result = part > result ? part : result;
          else
            result = 1.0f - (1.0f - result) * (1.0f - clampedUnit(part));
        }
        tone(x, y) = clampedUnit(result);
      }
  });
}

}  // namespace kagefude
