#include "passes/brush_rows.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush_block.h"
#include "passes/brush_samples.h"
#include "passes/brush_taps.h"
#include "passes/strip_lookup.h"

namespace kagefude {
namespace {

/// The block's places on the strip, at most three axes and two octaves a pixel.
struct TapList {
  static constexpr int most = 6 * brushBlock;
  int count = 0;
  alignas(64) int pixel[most];
  alignas(64) float u[most], weight[most];
  alignas(64) float ux[most], vx[most], uy[most], vy[most];
  alignas(64) float probes[most], lod[most], stepU[most], stepV[most];
};

void listTaps(const BrushAnchor& anchor, int count, const BrushBlock& block, TapList& taps) {
  const float perUnit = 1.0f / (2.0f * pi * anchor.mappingDistance);
  const float unit[2] = {perUnit, 0.5f * perUnit};
  const float share[2] = {1.0f - anchor.coarser, anchor.coarser};
  const float shift[2] = {anchor.shift, anchor.coarserShift};
  int n = 0;
  for (int i = 0; i < count; ++i) {
    if (block.here.absent[i + 1] != 0.0f) continue;
    for (int k = 0; k < 3; ++k) {
      if (!(block.weight[k][i] > 0.0f)) continue;
      for (int octave = 0; octave < 2; ++octave) {
        if (!(share[octave] > 0.0f)) continue;
        taps.pixel[n] = i;
        taps.u[n] = block.place[k][i] * unit[octave] + (axisOffset[k] + shift[octave]);
        taps.weight[n] = block.weight[k][i] * share[octave];
        taps.ux[n] = block.placeAcross[k][i] * unit[octave];
        taps.uy[n] = block.placeDown[k][i] * unit[octave];
        taps.vx[n] = block.across.tone[i];
        taps.vy[n] = block.down.tone[i];
        ++n;
      }
    }
  }
  taps.count = n;
}

KAGEFUDE_CLONES
void probeTaps(float w, float h, float maxProbes, TapList& taps) {
  float* __restrict probes = taps.probes, * __restrict lod = taps.lod, * __restrict stepU = taps.stepU, * __restrict stepV = taps.stepV;
#pragma GCC ivdep
  for (int i = 0; i < taps.count; ++i) {
    float n, level, du, dv;
    probeEllipse(taps.ux[i] * w, taps.vx[i] * h, taps.uy[i] * w, taps.vy[i] * h, w, h, maxProbes, n,
                 level, du, dv);
    probes[i] = n;
    lod[i] = level;
    stepU[i] = du;
    stepV[i] = dv;
  }
}

// Lists the lookups of one tap: its probes, each in one level or between two.
void listSamples(const TapList& taps, int tap, float tone, int lastLevel, SampleList& samples) {
  const int count = static_cast<int>(taps.probes[tap]);
  const float share = taps.weight[tap] / taps.probes[tap];
  const float most = static_cast<float>(lastLevel);
  const float lod = taps.lod[tap] < most ? taps.lod[tap] : most;
  const int fine = static_cast<int>(lod);
  const float coarser = lod - static_cast<float>(fine);
  const float middle = 0.5f * (taps.probes[tap] - 1.0f);
  for (int i = 0; i < count; ++i) {
    const float offset = static_cast<float>(i) - middle;
    const float u = taps.u[tap] + offset * taps.stepU[tap];
    const float v = tone + offset * taps.stepV[tap];
    samples.add(u, v, fine, coarser > 0.0f ? share * (1.0f - coarser) : share);
    if (coarser > 0.0f) samples.add(u, v, fine + 1, share * coarser);
  }
}

/// Paints one block, in as many goes as the list of lookups needs.
class BlockPainter {
 public:
  BlockPainter(const BrushInput& in, const Strip& strip)
      : strip_(strip), levels_(strip), perPixel_(12 * in.params.maxProbes) {}

  void paint(const BrushBlock& block, const TapList& taps, int first, int count, ColourRows& out) {
    int tap = 0;
    for (int i = 0; i < count;) {
      samples_.count = 0;
      const int begin = i;
      for (; i < count && (i == begin || samples_.count + perPixel_ <= SampleList::most); ++i) {
        const float tone = block.here.tone[i + 1];
        for (; tap < taps.count && taps.pixel[tap] == i; ++tap)
          listSamples(taps, tap, tone, levels_.last, samples_);
        ends_[i] = samples_.count;
      }
      placeSamples(levels_, samples_);
      fetchAhead(strip_.pool.row(0), samples_);
      for (int j = begin, from = 0; j < i; from = ends_[j++]) store(block, j, from, first, out);
    }
  }

 private:
  void store(const BrushBlock& block, int i, int from, int first, ColourRows& out) {
    Rgba colour{};
    if (block.here.absent[i + 1] == 0.0f) {
      colour = sumSamples(strip_.pool.row(0), samples_, from, ends_[i]);
      if (block.meanGain[i] != 0.0f)
        colour += stripRowMean(strip_, block.here.tone[i + 1]) * block.meanGain[i];
      colour = colour > 0.0f ? colour : Rgba{};
      if (strip_.opaque) colour[3] = 1.0f;
    }
    out.store(first + i, colour);
  }

  const Strip& strip_;
  LevelTable levels_;
  int perPixel_;
  int ends_[brushBlock];
  SampleList samples_;
};

}  // namespace

bool canPaintHeldRow(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.mapping == BrushParams::Mapping::held &&
         in.params.filter == BrushParams::Filter::anisotropic && anchor.points.size() == 1 &&
         12 * in.params.maxProbes <= SampleList::most;
}

void paintHeldRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  ColourRows& out) {
  const Strip& strip = in.strips[static_cast<size_t>(anchor.strip)];
  BrushBlock block;
  TapList taps;
  BlockPainter painter(in, strip);
  for (int x = first; x < end; x += brushBlock) {
    const int count = std::min(end - x, brushBlock);
    prepareBlock(in, anchor, x, x + count, y, block);
    listTaps(anchor, count, block, taps);
    probeTaps(static_cast<float>(strip.width()), static_cast<float>(strip.height()),
              static_cast<float>(in.params.maxProbes), taps);
    painter.paint(block, taps, x, count, out);
  }
}

}  // namespace kagefude
