#include "passes/ground/paper_deposit.h"

#include "image/parallel.h"

namespace kagefude {

float depositShare(float height, float tone, float grain, const PaperParams& params) {
  constexpr float edge = 0.25f, byGrain = 0.1f;
  const float known = tone > 0.0f ? (tone < 1.0f ? tone : 1.0f) : 0.0f;
  const float load = params.pressure + params.byTone * (0.5f - known) + byGrain * grain;
  const float pressed = load > 0.0f ? (load < 1.0f ? load : 1.0f) : 0.0f;
  // From wholly bare at load 0 to wholly covered at load 1.
  const float excess = height - (1.0f - pressed) * (1.0f + 2.0f * edge) + edge;
  const float t = excess * (0.5f / edge) + 0.5f;
  const float c = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  const float covered = c * c * (3.0f - 2.0f * c);
  return 1.0f - params.strength * (1.0f - covered);
}

void depositPaint(const PaintViews& paint, View<const float> tone, View<const float> grain,
                  const ToothViews& tooth, const PaperParams& params) {
  parallelRows(paint.a.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < paint.a.width; ++x) {
        const float stroke = grain.empty() ? 0.0f : grain(x, y);
        const float share = depositShare(tooth.height(x, y), tone(x, y), stroke, params);
        const float shaded = share * reliefFactor(tooth.slope(x, y), params);
        paint.r(x, y) *= shaded;
        paint.g(x, y) *= shaded;
        paint.b(x, y) *= shaded;
        paint.a(x, y) *= share;
      }
  });
}

float reliefFactor(float slope, const PaperParams& params) {
  return 1.0f + 0.2f * params.relief * slope;
}

void shadeRelief(const PaintViews& picture, View<const float> slope, const PaperParams& params) {
  parallelRows(picture.a.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < picture.a.width; ++x) {
        const float factor = reliefFactor(slope(x, y), params);
        picture.r(x, y) *= factor;
        picture.g(x, y) *= factor;
        picture.b(x, y) *= factor;
      }
  });
}

}  // namespace kagefude
