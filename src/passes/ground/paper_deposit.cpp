#include "passes/ground/paper_deposit.h"

#include "image/clones.h"
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
constexpr int run = ToothRun::most;

/// What the paint's alpha and its colours are multiplied by.
struct Deposit {
  float share[run], shaded[run];
};

KAGEFUDE_CLONES void depositRun(const ToothRun& tooth, const float* tone, const float* grain,
                                int count, const PaperParams& params, Deposit& out) {
  for (int i = 0; i < count; ++i)
    out.share[i] = depositShare(tooth.height[i], tone[i], grain[i], params);
  for (int i = 0; i < count; ++i)
    out.shaded[i] = out.share[i] * reliefFactor(tooth.slope[i], params);
}

KAGEFUDE_CLONES void multiplyRun(float* values, const float* factors, int count) {
  for (int i = 0; i < count; ++i) values[i] *= factors[i];
}

}  // namespace

void depositPaint(const PaintViews& paint, View<const float> tone, View<const float> grain,
                  const PaperSurface& surface, const PaperParams& params) {
  const float level[run] = {};
  parallelRows(paint.a.height, [&](int first, int end) {
    ToothRun tooth;
    Deposit deposit;
    for (int y = first; y < end; ++y)
      for (int x = 0; x < paint.a.width; x += run) {
        const int count = paint.a.width - x < run ? paint.a.width - x : run;
        surface.read(x, y, count, tooth);
        depositRun(tooth, tone.row(y) + x, grain.empty() ? level : grain.row(y) + x, count, params,
                   deposit);
        for (const View<float>* plane : {&paint.r, &paint.g, &paint.b})
          multiplyRun(plane->row(y) + x, deposit.shaded, count);
        multiplyRun(paint.a.row(y) + x, deposit.share, count);
      }
  });
}

float reliefFactor(float slope, const PaperParams& params) {
  return 1.0f + 0.2f * params.relief * slope;
}

KAGEFUDE_CLONES void shadeFlat(const V3f& colour, const float* slope, int count,
                               const PaperParams& params, ColourRun& run) {
  const float r = colour.x, g = colour.y, b = colour.z;
  for (int i = 0; i < count; ++i) {
    const float factor = reliefFactor(slope[i], params);
    run.r[i] = r * factor;
    run.g[i] = g * factor;
    run.b[i] = b * factor;
    run.a[i] = 1.0f;
  }
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
