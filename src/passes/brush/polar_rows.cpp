#include "passes/brush/polar_rows.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "image/real_math.h"
#include "passes/brush/brush_block.h"
#include "passes/brush/brush_taps.h"
#include "passes/brush/tap_rows.h"

namespace kagefude {
namespace {

/// Where a block's pixels lie round the axis: in turns, which change so much across and down, and
/// so far from it.
struct Turns {
  alignas(64) float angle[brushBlock], across[brushBlock], down[brushBlock];
  alignas(64) float distance[brushBlock];
};

/// The rings of one octave: repeats of the inner one, share of the next.
struct Rings {
  alignas(64) float count[brushBlock], next[brushBlock];
};

/// Three numbers of every pixel: a place, or how it changes.
struct Triple {
  const float *x, *y, *z;
};

/// The vectors that a place is measured by: a = l1 . (place - from) + shift1, b alike.
struct Measure {
  V3f l1, l2, from;
  float shift1 = 0, shift2 = 0;
};

// Places at rest are along the object's axes, from its origin.
Measure measureOf(const BrushAnchor& anchor, bool atRest) {
  const BrushAnchor::Point& point = anchor.points.front();
  const V3f &l1 = point.frame.l1, &l2 = point.frame.l2;
  if (!atRest) return {l1, l2, point.position};
  const V3f way = anchor.object.origin - point.position;
  return {alongAxes(anchor.object, l1), alongAxes(anchor.object, l2), V3f(0.0f), l1.dot(way),
          l2.dot(way)};
}

// As addRing: d atan2(a, b) = (b da - a db) / (a^2 + b^2).
KAGEFUDE_CLONES
void findTurns(const Measure& m, Triple place, Triple across, Triple down, int count,
               Turns& turns) {
  float* __restrict angle = turns.angle, * __restrict distance = turns.distance;
  float* __restrict turnsAcross = turns.across, * __restrict turnsDown = turns.down;
  const V3f l1 = m.l1, l2 = m.l2, from = m.from;
  const float shift1 = m.shift1, shift2 = m.shift2;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float x = place.x[i] - from.x, y = place.y[i] - from.y, z = place.z[i] - from.z;
    const float a = l1.x * x + l1.y * y + l1.z * z + shift1;
    const float b = l2.x * x + l2.y * y + l2.z * z + shift2;
    const float squared = a * a + b * b;
    const float scale = squared > 0.0f ? 1.0f / (2.0f * pi * squared) : 0.0f;
    const float aAcross = l1.x * across.x[i] + l1.y * across.y[i] + l1.z * across.z[i];
    const float bAcross = l2.x * across.x[i] + l2.y * across.y[i] + l2.z * across.z[i];
    const float aDown = l1.x * down.x[i] + l1.y * down.y[i] + l1.z * down.z[i];
    const float bDown = l2.x * down.x[i] + l2.y * down.y[i] + l2.z * down.z[i];
    angle[i] = turnsOf(a, b);
    turnsAcross[i] = (b * aAcross - a * bAcross) * scale;
    turnsDown[i] = (b * aDown - a * bDown) * scale;
    distance[i] = std::sqrt(squared);
  }
}

// As brushRepeat; the innermost ring draws ring 1's strokes alone.
KAGEFUDE_CLONES
void findRings(const Turns& turns, float mappingDistance, float blendWidth, int count,
               Rings& rings) {
  const float blends = blendWidth > 0.0f ? 1.0f : 0.0f;
  const float width = blendWidth > 0.0f ? blendWidth : 1.0f;
  const float* __restrict distance = turns.distance;
  float* __restrict counts = rings.count, * __restrict next = rings.next;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float place = distance[i] / mappingDistance;
    const float inner = std::floor(place);
    const float fraction = place - inner;
    const float blended =
        fraction >= 1.0f - width ? ((fraction - 1.0f) / width + 1.0f) * blends : 0.0f;
    counts[i] = inner < 1.0f ? 1.0f : inner;
    next[i] = inner < 1.0f ? 0.0f : blended;
  }
}

// Turns the rings' shares into weights that keep the contrast (or not), faded round the axis.
KAGEFUDE_CLONES
void gainStrokes(const Turns& turns, const Rings& fine, const Rings& coarse, float coarser,
                 float contrast, float keep, float perFade, int count, float* __restrict gain,
                 float* __restrict mean) {
  const float* __restrict distance = turns.distance;
  const float finer = 1.0f - coarser;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float n = fine.next[i], m = coarse.next[i];
    const float squares = finer * finer * ((1.0f - n) * (1.0f - n) + n * n) +
                          coarser * coarser * ((1.0f - m) * (1.0f - m) + m * m);
    const float t = distance[i] * perFade;
    const float c = t < 1.0f ? t : 1.0f;
    const float amplitude = perFade > 0.0f ? c * c * (3.0f - 2.0f * c) : 1.0f;
    const float kept = contrast / std::sqrt(squares);
    gain[i] = amplitude * (keep > 0.0f ? kept : contrast);
    mean[i] = 1.0f - gain[i];
  }
}

/// The strokes of one octave.
struct Octave {
  const Rings& rings;
  float shift, share;
};

class PolarTaps {
 public:
  PolarTaps(const BrushInput& in, const BrushAnchor& anchor)
      : in_(in),
        anchor_(anchor),
        atRest_(liesAtRest(in, anchor)),
        measure_(measureOf(anchor, atRest_)) {}

  /// Fills `taps` and the block's mean gains.
  void list(int count, BrushBlock& block, TapList& taps) {
    locate(count, block);
    const float mapping = anchor_.mappingDistance, width = in_.params.blendWidth;
    findRings(turns_, mapping, width, count, fine_);
    findRings(turns_, 2.0f * mapping, width, count, coarse_);
    const float fade = in_.params.poleFade * mapping * (1.0f + anchor_.coarser);
    const bool keeps = in_.params.crossFade == BrushParams::CrossFade::variance;
    gainStrokes(turns_, fine_, coarse_, anchor_.coarser, in_.params.contrast, keeps ? 1.0f : 0.0f,
                fade > 0.0f ? 1.0f / fade : 0.0f, count, gain_, block.meanGain);
    taps.count = 0;
    for (int i = 0; i < count; ++i) {
      if (block.here.absent[i + 1] == 0.0f) {
        add({fine_, anchor_.shift, 1.0f - anchor_.coarser}, block, i, taps);
        add({coarse_, anchor_.coarserShift, anchor_.coarser}, block, i, taps);
      }
      taps.ends[i] = taps.count;
    }
  }

 private:
  void locate(int count, const BrushBlock& block) {
    const auto along = [](const float(&planes)[3][brushBlock]) {
      return Triple{planes[0], planes[1], planes[2]};
    };
    const auto change = [](const BrushBlock::Change& c) { return Triple{c.x, c.y, c.z}; };
    if (atRest_)
      findTurns(measure_, along(block.place), along(block.placeAcross), along(block.placeDown),
                count, turns_);
    else
      findTurns(measure_, {block.here.x + 1, block.here.y + 1, block.here.z + 1},
                change(block.across), change(block.down), count, turns_);
  }

  void add(const Octave& octave, const BrushBlock& block, int i, TapList& taps) const {
    const float inner = octave.rings.count[i], next = octave.rings.next[i];
    addRing(inner, octave.share * (1.0f - next), octave.shift, block, i, taps);
    addRing(inner + 1.0f, octave.share * next, octave.shift, block, i, taps);
  }

  void addRing(float repeats, float share, float shift, const BrushBlock& block, int i,
               TapList& taps) const {
    if (!(share > 0.0f)) return;
    const int n = taps.count++;
    taps.u[n] = turns_.angle[i] * repeats + shift;
    taps.tone[n] = block.here.tone[i + 1];
    taps.weight[n] = share * gain_[i];
    taps.ux[n] = turns_.across[i] * repeats;
    taps.uy[n] = turns_.down[i] * repeats;
    taps.vx[n] = block.across.tone[i];
    taps.vy[n] = block.down.tone[i];
  }

  const BrushInput& in_;
  const BrushAnchor& anchor_;
  bool atRest_;
  Measure measure_;
  Turns turns_;
  Rings fine_, coarse_;
  alignas(64) float gain_[brushBlock];
};

}  // namespace

bool canPaintPolarRow(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.mapping == BrushParams::Mapping::polar &&
         in.params.filter == BrushParams::Filter::anisotropic && anchor.points.size() == 1 &&
         BlockPainter::hasRoom(in.params);
}

void paintPolarRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                   ColourRows& out) {
  BrushBlock block;
  TapList taps;
  PolarTaps polar(in, anchor);
  BlockPainter painter(in, in.strips[static_cast<size_t>(anchor.strip)]);
  for (int x = first; x < end; x += brushBlock) {
    const int count = std::min(end - x, brushBlock);
    loadBlock(in, anchor, x, x + count, y, block);
    polar.list(count, block, taps);
    painter.paint(block, taps, in.params, x, count, out);
  }
}

}  // namespace kagefude
