#include "passes/brush_rows.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush_taps.h"
#include "passes/strip_lookup.h"

namespace kagefude {
namespace {

constexpr int blockSize = 128;
constexpr int mostTaps = 6;

/// A block's pixels with one neighbour on either side. Where `ok` is 0 the values mean nothing.
struct Line {
  alignas(64) float x[blockSize + 2], y[blockSize + 2], z[blockSize + 2], tone[blockSize + 2];
  alignas(64) float ok[blockSize + 2];
};

/// What is worked out for each pixel of a block.
struct Block {
  Line above, here, below;
  alignas(64) float normalX[blockSize], normalY[blockSize], normalZ[blockSize];
  alignas(64) float dx[3][blockSize], dy[3][blockSize];
  alignas(64) float toneDx[blockSize], toneDy[blockSize];
  alignas(64) float place[3][blockSize], placeDx[3][blockSize], placeDy[3][blockSize];
  alignas(64) float weight[3][blockSize];
};

/// The block's lookups, one after the other.
struct TapList {
  int count = 0;
  alignas(64) int pixel[mostTaps * blockSize];
  alignas(64) float u[mostTaps * blockSize], weight[mostTaps * blockSize];
  alignas(64) float ux[mostTaps * blockSize], vx[mostTaps * blockSize];
  alignas(64) float uy[mostTaps * blockSize], vy[mostTaps * blockSize];
  alignas(64) float probes[mostTaps * blockSize], lod[mostTaps * blockSize];
  alignas(64) float stepU[mostTaps * blockSize], stepV[mostTaps * blockSize];
};

// Pixels [first - 1, end + 1) of row y; ok says that they belong to the anchor of index `own`.
KAGEFUDE_CLONES void loadLine(const BrushInput& in, int first, int end, int y, uint16_t own,
                              Line& line) {
  if (y < 0 || y >= in.index.height) {
    std::fill_n(line.ok, end - first + 2, 0.0f);
    return;
  }
  const int begin = std::max(first - 1, 0), stop = std::min(end + 1, in.index.width);
  const int shift = begin - (first - 1), count = stop - begin;
  line.ok[0] = line.ok[end - first + 1] = 0.0f;
  const float *px = in.position.x.row(y) + begin, *py = in.position.y.row(y) + begin,
              *pz = in.position.z.row(y) + begin, *tone = in.tone.row(y) + begin;
  const uint16_t* index = in.index.row(y) + begin;
  for (int i = 0; i < count; ++i) {
    line.x[i + shift] = px[i];
    line.y[i + shift] = py[i];
    line.z[i + shift] = pz[i];
    line.tone[i + shift] = clampedUnit(tone[i]);
    const float sum = px[i] + py[i] + pz[i];
    line.ok[i + shift] = (sum - sum == 0.0f) & (index[i] == own) ? 1.0f : 0.0f;
  }
}

KAGEFUDE_CLONES void loadNormals(const BrushInput& in, int first, int count, int y, Block& block) {
  const float *nx = in.normal.x.row(y) + first, *ny = in.normal.y.row(y) + first,
              *nz = in.normal.z.row(y) + first;
  for (int i = 0; i < count; ++i) {
    const float length = std::sqrt(nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i]);
    const float sum = nx[i] + ny[i] + nz[i];
    const bool good = (length > 0.0f) & (sum - sum == 0.0f);
    block.normalX[i] = good ? nx[i] / length : 0.0f;
    block.normalY[i] = good ? ny[i] / length : 0.0f;
    block.normalZ[i] = good ? nz[i] / length : 0.0f;
  }
}

// As changeAlong of the plain pass: of the neighbour before (offset -1) and behind, the nearer one.
KAGEFUDE_CLONES void changes(const Line& here, const Line& behind, int offsetBehind,
                             const Line& before, int offsetBefore, int count, float* dx, float* dy,
                             float* dz, float* dTone) {
  constexpr float none = 3.0e38f;
  for (int i = 0; i < count; ++i) {
    const int c = i + 1, f = c + offsetBehind, b = c + offsetBefore;
    const float fx = behind.x[f] - here.x[c], fy = behind.y[f] - here.y[c],
                fz = behind.z[f] - here.z[c], ft = behind.tone[f] - here.tone[c];
    const float bx = here.x[c] - before.x[b], by = here.y[c] - before.y[b],
                bz = here.z[c] - before.z[b], bt = here.tone[c] - before.tone[b];
    const bool hasBehind = behind.ok[f] > 0.0f, hasBefore = before.ok[b] > 0.0f;
    const float lengthF = hasBehind ? fx * fx + fy * fy + fz * fz : none;
    const float lengthB = hasBefore ? bx * bx + by * by + bz * bz : none;
    const bool useB = hasBefore & (!hasBehind | (lengthB < lengthF));
    const bool any = hasBehind | hasBefore;
    dx[i] = any ? (useB ? bx : fx) : 0.0f;
    dy[i] = any ? (useB ? by : fy) : 0.0f;
    dz[i] = any ? (useB ? bz : fz) : 0.0f;
    const bool useToneB = hasBefore & (!hasBehind | (std::fabs(bt) < std::fabs(ft)));
    dTone[i] = any ? (useToneB ? bt : ft) : 0.0f;
  }
}

// Places along the object's axes, their change, and the axes' weights, as addHeldTaps.
KAGEFUDE_CLONES void holdToAxes(const BrushAnchor& anchor, bool hasNormal, int count,
                                Block& block) {
  const V3f g = anchor.points[0].position, v = anchor.points[0].frame.axis;
  const V3f o = anchor.object.origin;
  const V3f axes[3] = {anchor.object.x, anchor.object.y, anchor.object.z};
  const float near = heldNearAxis * anchor.mappingDistance;
  for (int i = 0; i < count; ++i) {
    const float x = block.here.x[i + 1], y = block.here.y[i + 1], z = block.here.z[i + 1];
    const float gx = x - g.x, gy = y - g.y, gz = z - g.z;
    float tx = v.y * gz - v.z * gy, ty = v.z * gx - v.x * gz, tz = v.x * gy - v.y * gx;
    const float nx = hasNormal ? block.normalX[i] : 0.0f;
    const float ny = hasNormal ? block.normalY[i] : 0.0f;
    const float nz = hasNormal ? block.normalZ[i] : 0.0f;
    const float off = nx * tx + ny * ty + nz * tz;
    tx -= nx * off;
    ty -= ny * off;
    tz -= nz * off;
    float part[3];
    for (int k = 0; k < 3; ++k) {
      const float along = tx * axes[k].x + ty * axes[k].y + tz * axes[k].z;
      part[k] = near * near + along * along;
    }
    const float sum = part[0] + part[1] + part[2];
    for (int k = 0; k < 3; ++k) {
      const float excess = part[k] / sum - axisThreshold;
      block.weight[k][i] = excess > 0.0f ? excess * excess : 0.0f;
      block.place[k][i] = axes[k].x * (x - o.x) + axes[k].y * (y - o.y) + axes[k].z * (z - o.z);
      block.placeDx[k][i] =
          axes[k].x * block.dx[0][i] + axes[k].y * block.dx[1][i] + axes[k].z * block.dx[2][i];
      block.placeDy[k][i] =
          axes[k].x * block.dy[0][i] + axes[k].y * block.dy[1][i] + axes[k].z * block.dy[2][i];
    }
  }
}

void listTaps(const BrushAnchor& anchor, int count, const Block& block, TapList& taps) {
  const float perUnit = 1.0f / (2.0f * pi * anchor.mappingDistance);
  const float unit[2] = {perUnit, 0.5f * perUnit};
  const float share[2] = {1.0f - anchor.coarser, anchor.coarser};
  const float shift[2] = {anchor.shift, anchor.coarserShift};
  int n = 0;
  for (int i = 0; i < count; ++i) {
    if (!(block.here.ok[i + 1] > 0.0f)) continue;
    for (int k = 0; k < 3; ++k) {
      if (!(block.weight[k][i] > 0.0f)) continue;
      for (int octave = 0; octave < 2; ++octave) {
        if (!(share[octave] > 0.0f)) continue;
        taps.pixel[n] = i;
        taps.u[n] = block.place[k][i] * unit[octave] + (axisOffset[k] + shift[octave]);
        taps.weight[n] = block.weight[k][i] * share[octave];
        taps.ux[n] = block.placeDx[k][i] * unit[octave];
        taps.uy[n] = block.placeDy[k][i] * unit[octave];
        taps.vx[n] = block.toneDx[i];
        taps.vy[n] = block.toneDy[i];
        ++n;
      }
    }
  }
  taps.count = n;
}

KAGEFUDE_CLONES void probeTaps(const Strip& strip, float maxProbes, TapList& taps) {
  const float w = static_cast<float>(strip.width()), h = static_cast<float>(strip.height());
  for (int i = 0; i < taps.count; ++i)
    probeEllipse(taps.ux[i] * w, taps.vx[i] * h, taps.uy[i] * w, taps.vy[i] * h, w, h, maxProbes,
                 taps.probes[i], taps.lod[i], taps.stepU[i], taps.stepV[i]);
}

Rgba tapColour(const Strip& strip, const TapList& taps, int i, float tone) {
  const StripProbe probe{taps.stepU[i], taps.stepV[i], taps.lod[i],
                         static_cast<int>(taps.probes[i])};
  return lookUp(strip, taps.u[i], tone, probe);
}

// Mixes the taps [first, end) of one pixel, as mixedColour of the plain pass.
Rgba mixPixel(const BrushInput& in, const Strip& strip, const TapList& taps, int first, int end,
              float tone, float dTone) {
  const float contrast = in.params.contrast;
  const bool several = end - first > 1;
  if (!several && contrast == 1.0f) return tapColour(strip, taps, first, tone);
  Rgba colours{};
  float sum = 0, squares = 0;
  for (int tap = first; tap < end; ++tap) {
    const float weight = taps.weight[tap];
    colours += tapColour(strip, taps, tap, tone) * weight;
    sum += weight;
    squares += weight * weight;
  }
  const Rgba plain = colours / sum;
  const bool keepContrast = several && in.params.crossFade == BrushParams::CrossFade::variance;
  if (contrast == 1.0f && !keepContrast) return plain;
  const float gain = keepContrast ? contrast * sum / std::sqrt(squares) : contrast;
  const Rgba mean = stripRowMean(strip, tone, dTone);
  const Rgba mixed = mean + (plain - mean) * gain;
  return mixed > 0.0f ? mixed : Rgba{};
}

void mixTaps(const BrushInput& in, const Strip& strip, const Block& block, const TapList& taps,
             int first, int count, ColourRows& out) {
  int tap = 0;
  for (int i = 0; i < count; ++i) {
    const int begin = tap;
    while (tap < taps.count && taps.pixel[tap] == i) ++tap;
    const float dTone = std::max(std::fabs(block.toneDx[i]), std::fabs(block.toneDy[i]));
    out.store(first + i, tap > begin
                             ? mixPixel(in, strip, taps, begin, tap, block.here.tone[i + 1], dTone)
                             : Rgba{});
  }
}

void prepareBlock(const BrushInput& in, const BrushAnchor& anchor, const Strip& strip, int first,
                  int end, int y, Block& block, TapList& taps) {
  const int count = end - first;
  const uint16_t own = in.index(first, y);
  loadLine(in, first, end, y - 1, own, block.above);
  loadLine(in, first, end, y, own, block.here);
  loadLine(in, first, end, y + 1, own, block.below);
  if (!in.normal.empty()) loadNormals(in, first, count, y, block);
  changes(block.here, block.here, 1, block.here, -1, count, block.dx[0], block.dx[1], block.dx[2],
          block.toneDx);
  changes(block.here, block.below, 0, block.above, 0, count, block.dy[0], block.dy[1], block.dy[2],
          block.toneDy);
  holdToAxes(anchor, !in.normal.empty(), count, block);
  listTaps(anchor, count, block, taps);
  probeTaps(strip, static_cast<float>(in.params.maxProbes), taps);
}

}  // namespace

bool canPaintHeldRow(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.mapping == BrushParams::Mapping::held &&
         in.params.filter == BrushParams::Filter::anisotropic && anchor.points.size() == 1;
}

void paintHeldRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  ColourRows& out) {
  const Strip& strip = in.strips[static_cast<size_t>(anchor.strip)];
  Block block;
  TapList taps;
  for (int x = first; x < end; x += blockSize) {
    const int stop = std::min(end, x + blockSize);
    prepareBlock(in, anchor, strip, x, stop, y, block, taps);
    mixTaps(in, strip, block, taps, x, stop - x, out);
  }
}

}  // namespace kagefude
