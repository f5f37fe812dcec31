#include "passes/brush/brush_rows.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush/brush_block.h"
#include "passes/brush/brush_samples.h"
#include "passes/brush/brush_taps.h"
#include "passes/strip/strip_lookup.h"

namespace kagefude {
namespace {

/// The block's places on the strip, at most three axes and two octaves a pixel.
struct TapList {
  static constexpr int most = 6 * brushBlock;
  int count = 0;
  int ends[brushBlock];  ///< behind each pixel's last tap
  alignas(64) float u[most], tone[most], weight[most];
  alignas(64) float ux[most], vx[most], uy[most], vy[most];
  alignas(64) float stepU[most], stepV[most], coarser[most];
  alignas(64) int probes[most], level[most];
};

// Taps of every pixel at one or two octaves.
template <int octaves>
void listTaps(const BrushAnchor& anchor, int count, const BrushBlock& block, TapList& taps) {
  const float perUnit = 1.0f / (2.0f * pi * anchor.mappingDistance);
  const float unit[2] = {perUnit, 0.5f * perUnit};
  const float share[2] = {1.0f - anchor.coarser, anchor.coarser};
  const float shift[2] = {anchor.shift, anchor.coarserShift};
  int n = 0;
  for (int i = 0; i < count; ++i) {
    const bool present = block.here.absent[i + 1] == 0.0f;
    for (int k = 0; k < 3; ++k) {
      const float weight = block.weight[k][i];
      if (!(present && weight > 0.0f)) continue;
      for (int octave = 0; octave < octaves; ++octave, ++n) {
        taps.u[n] = block.place[k][i] * unit[octave] + (axisOffset[k] + shift[octave]);
        taps.tone[n] = block.here.tone[i + 1];
        taps.weight[n] = weight * share[octave];
        taps.ux[n] = block.placeAcross[k][i] * unit[octave];
        taps.uy[n] = block.placeDown[k][i] * unit[octave];
        taps.vx[n] = block.across.tone[i];
        taps.vy[n] = block.down.tone[i];
      }
    }
    taps.ends[i] = n;
  }
  taps.count = n;
}

// Splits every tap's footprint into probes; from here on `weight` is one probe's.
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

/// Paints one block, in as many goes as the list of lookups needs.
class BlockPainter {
 public:
  BlockPainter(const BrushInput& in, const Strip& strip)
      : strip_(strip), levels_(strip), perPixel_(12 * in.params.maxProbes) {}

  int lastLevel() const { return levels_.last; }

  void paint(const BrushBlock& block, const TapList& taps, int first, int count, ColourRows& out) {
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

 private:
  Rgba mixed(const BrushBlock& block, int i, int from, int end) const {
    if (block.here.absent[i + 1] != 0.0f) return Rgba{};
    Rgba colour = sumSamples(strip_.pool.row(0), samples_, from, end);
    if (block.meanGain[i] != 0.0f)
      colour += stripRowMean(strip_, block.here.tone[i + 1]) * block.meanGain[i];
    colour = colour > 0.0f ? colour : Rgba{};
    if (strip_.opaque) colour[3] = 1.0f;
    return colour;
  }

  const Strip& strip_;
  LevelTable levels_;
  int perPixel_;
  int ends_[brushBlock];
  Rgba colours_[brushBlock];
  SampleList samples_;
};

}  // namespace

bool canPaintHeldRow(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.mapping == BrushParams::Mapping::held &&
         in.params.grain == BrushParams::Grain::tone &&
         in.params.filter == BrushParams::Filter::anisotropic && anchor.points.size() == 1 &&
         !keepsSizeInWorld(in, anchor) && !(liesAtRest(in, anchor) && anchor.placesTurned) &&
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
    if (anchor.coarser > 0.0f)
      listTaps<2>(anchor, count, block, taps);
    else
      listTaps<1>(anchor, count, block, taps);
    probeTaps(static_cast<float>(strip.width()), static_cast<float>(strip.height()),
              static_cast<float>(in.params.maxProbes), painter.lastLevel(), taps);
    painter.paint(block, taps, x, count, out);
  }
}

}  // namespace kagefude
