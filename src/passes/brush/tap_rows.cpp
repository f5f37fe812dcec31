#include "passes/brush/tap_rows.h"

#include "image/clones.h"
#include "passes/strip/strip_lookup.h"

namespace kagefude {
namespace {

// Lists the lookups of one tap: its probes, each in one level or between two.
inline void listSamples(const TapList& taps, int tap, SampleList& samples) {
  const float weight = taps.weight[tap], coarser = taps.coarser[tap];
  const int level = taps.level[tap], count = taps.probes[tap];
  const float middle = 0.5f * static_cast<float>(count - 1);
  for (int i = 0; i < count; ++i) {
    const float offset = static_cast<float>(i) - middle;
    const float u = taps.u[tap] + offset * taps.stepU[tap];
    const float v = taps.tone[tap] + offset * taps.stepV[tap];
    samples.add(u, v, level, weight * (1.0f - coarser));
    if (coarser > 0.0f) samples.add(u, v, level + 1, weight * coarser);
  }
}

// Splits every tap's footprint on a strip of w x h texels into probes; from then on `weight` is one
// probe's.
KAGEFUDE_CLONES
void probeTaps(float w, float h, float maxProbes, int lastLevel, TapList& taps) {
  const float most = static_cast<float>(lastLevel);
  float* __restrict weight = taps.weight, * __restrict coarser = taps.coarser;
  float* __restrict stepU = taps.stepU, * __restrict stepV = taps.stepV;
  int* __restrict probes = taps.probes, * __restrict level = taps.level;
  const int count = taps.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    float n, lod, du, dv;
    probeEllipse(taps.ux[i] * w, taps.vx[i] * h, taps.uy[i] * w, taps.vy[i] * h, w, h, maxProbes, n,
                 lod, du, dv);
    const float between = lod < most ? lod : most;
    const int fine = static_cast<int>(between);
    weight[i] /= n;
    probes[i] = static_cast<int>(n);
    level[i] = fine;
    coarser[i] = between - static_cast<float>(fine);
    stepU[i] = du;
    stepV[i] = dv;
  }
}

}  // namespace

Rgba BlockPainter::mixed(const BrushBlock& block, int i, int from, int end) const {
  if (block.here.absent[i + 1] != 0.0f) return Rgba{};
  Rgba colour = sumSamples(strip_.pool.row(0), samples_, from, end);
  if (block.meanGain[i] != 0.0f)
    colour += stripRowMean(strip_, block.here.tone[i + 1]) * block.meanGain[i];
  colour = colour > 0.0f ? colour : Rgba{};
  if (strip_.opaque) colour[3] = 1.0f;
  return colour;
}

void BlockPainter::paint(const BrushBlock& block, TapList& taps, const BrushParams& params,
                         int first, int count, ColourRows& out) {
  probeTaps(static_cast<float>(strip_.width()), static_cast<float>(strip_.height()),
            static_cast<float>(params.maxProbes), levels_.last, taps);
  int tap = 0;
  for (int i = 0; i < count;) {
    samples_.count = 0;
    const int begin = i;
    for (; i < count && (i == begin || samples_.count + perPixel_ <= SampleList::most); ++i) {
      for (; tap < taps.ends[i]; ++tap) listSamples(taps, tap, samples_);
      ends_[i] = samples_.count;
    }
    placeSamples(levels_, samples_);
    fetchAhead(strip_.pool.row(0), samples_);
    for (int j = begin, from = 0; j < i; from = ends_[j++])
      colours_[j] = mixed(block, j, from, ends_[j]);
  }
  for (int i = 0; i < count; ++i) out.store(first + i, colours_[i]);
}

}  // namespace kagefude
