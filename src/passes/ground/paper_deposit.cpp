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

namespace {

/// Pixels that are worked on at a time: shares first, then plane by plane, each a plain loop.
constexpr int run = 256;

/// What the paint's alpha and its colours are multiplied by.
struct Deposit {
  float share[run], shaded[run];
};

void depositRun(const float* height, const float* slope, const float* tone, const float* grain,
                int count, const PaperParams& params, Deposit& out) {
  for (int i = 0; i < count; ++i)
    out.share[i] = depositShare(height[i], tone[i], grain ? grain[i] : 0.0f, params);
  for (int i = 0; i < count; ++i) out.shaded[i] = out.share[i] * reliefFactor(slope[i], params);
}

void multiplyRun(float* values, const float* factors, int count) {
  for (int i = 0; i < count; ++i) values[i] *= factors[i];
}

}  // namespace

void depositPaint(const PaintViews& paint, View<const float> tone, View<const float> grain,
                  const ToothViews& tooth, const PaperParams& params) {
  parallelRows(paint.a.height, [&](int first, int end) {
    Deposit deposit;
    for (int y = first; y < end; ++y)
      for (int x = 0; x < paint.a.width; x += run) {
        const int count = paint.a.width - x < run ? paint.a.width - x : run;
        depositRun(tooth.height.row(y) + x, tooth.slope.row(y) + x, tone.row(y) + x,
                   grain.empty() ? nullptr : grain.row(y) + x, count, params, deposit);
        for (const View<float>* plane : {&paint.r, &paint.g, &paint.b})
          multiplyRun(plane->row(y) + x, deposit.shaded, count);
        multiplyRun(paint.a.row(y) + x, deposit.share, count);
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
