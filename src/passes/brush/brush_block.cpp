#include "passes/brush/brush_block.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush/block_space.h"
#include "passes/brush/brush_taps.h"
#include "passes/brush/rest_block.h"

namespace kagefude {
namespace {

using Line = BrushBlock::Line;
using Change = BrushBlock::Change;

KAGEFUDE_CLONES
void copyLine(const float* px, const float* py, const float* pz, const float* tone,
              const uint16_t* index, uint16_t own, int count, int shift, Line& line) {
  float* __restrict x = line.x + shift, * __restrict y = line.y + shift;
  float* __restrict z = line.z + shift, * __restrict t = line.tone + shift;
  float* __restrict absent = line.absent + shift;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float sum = px[i] + py[i] + pz[i];
    const float broken = sum - sum == 0.0f ? 0.0f : noChange;
    const float far = index[i] == own ? broken : noChange;
    absent[i] = far;
    x[i] = far == 0.0f ? px[i] : 0.0f;
    y[i] = far == 0.0f ? py[i] : 0.0f;
    z[i] = far == 0.0f ? pz[i] : 0.0f;
    t[i] = clampedUnit(tone[i]);
  }
}

void clearPixel(Line& line, int i) {
  line.x[i] = line.y[i] = line.z[i] = line.tone[i] = 0.0f;
  line.absent[i] = noChange;
}

// Pixels [first - 1, end + 1) of row y.
void loadLine(const BrushInput& in, int first, int end, int y, uint16_t own, Line& line) {
  const int pixels = end - first + 2;
  if (y < 0 || y >= in.index.height) {
    for (int i = 0; i < pixels; ++i) clearPixel(line, i);
    return;
  }
  clearPixel(line, 0);
  clearPixel(line, pixels - 1);
  const int begin = std::max(first - 1, 0), stop = std::min(end + 1, in.index.width);
  copyLine(in.position.x.row(y) + begin, in.position.y.row(y) + begin, in.position.z.row(y) + begin,
           in.tone.row(y) + begin, in.index.row(y) + begin, own, stop - begin, begin - (first - 1),
           line);
}

KAGEFUDE_CLONES
void unitNormals(const float* nx, const float* ny, const float* nz, int count, BrushBlock& block) {
  float* __restrict ox = block.normalX, * __restrict oy = block.normalY, * __restrict oz = block.normalZ;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float length = std::sqrt(nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i]);
    const float sum = nx[i] + ny[i] + nz[i];
    const float finite = sum - sum == 0.0f ? length : 0.0f;
    const float scale = finite > 0.0f ? 1.0f / finite : 0.0f;
    ox[i] = finite > 0.0f ? nx[i] * scale : 0.0f;
    oy[i] = finite > 0.0f ? ny[i] * scale : 0.0f;
    oz[i] = finite > 0.0f ? nz[i] * scale : 0.0f;
  }
}

// As changeAlong of the plain pass. The offsets make index i the neighbour of pixel i.
KAGEFUDE_CLONES
void changes(const Line& here, const Line& behind, int offsetBehind, const Line& before,
             int offsetBefore, int count, Change& change) {
  float *__restrict dx = change.x, *__restrict dy = change.y, *__restrict dz = change.z,
                    *__restrict dTone = change.tone;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const int c = i + 1, f = i + offsetBehind, b = i + offsetBefore;
    const float fx = behind.x[f] - here.x[c], gx = here.x[c] - before.x[b];
    const float fy = behind.y[f] - here.y[c], gy = here.y[c] - before.y[b];
    const float fz = behind.z[f] - here.z[c], gz = here.z[c] - before.z[b];
    const float ft = behind.tone[f] - here.tone[c], gt = here.tone[c] - before.tone[b];
    const float lengthF = fx * fx + fy * fy + fz * fz + behind.absent[f];
    const float lengthG = gx * gx + gy * gy + gz * gz + before.absent[b];
    const float toneF = std::fabs(ft) + behind.absent[f];
    const float toneG = std::fabs(gt) + before.absent[b];
    const float x = lengthG < lengthF ? gx : fx;
    const float y = lengthG < lengthF ? gy : fy;
    const float z = lengthG < lengthF ? gz : fz;
    const float least = lengthG < lengthF ? lengthG : lengthF;
    const float t = toneG < toneF ? gt : ft;
    const float mostTone = toneG < toneF ? toneF : toneG;
    const bool alike = mostTone < noChange && ft * gt > 0.0f;
    dx[i] = least < noChange ? x : 0.0f;
    dy[i] = least < noChange ? y : 0.0f;
    dz[i] = least < noChange ? z : 0.0f;
    dTone[i] = alike ? t : 0.0f;
  }
}

// Place and its change along one of the object's axes.
KAGEFUDE_CLONES
void placesAlong(V3f axis, V3f origin, int count, int k, BrushBlock& block) {
  float *__restrict place = block.place[k], *__restrict across = block.placeAcross[k],
                    *__restrict down = block.placeDown[k];
  const float *x = block.here.x + 1, *y = block.here.y + 1, *z = block.here.z + 1;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    place[i] = axis.x * (x[i] - origin.x) + axis.y * (y[i] - origin.y) + axis.z * (z[i] - origin.z);
    across[i] =
        axis.x * block.across.x[i] + axis.y * block.across.y[i] + axis.z * block.across.z[i];
    down[i] = axis.x * block.down.x[i] + axis.y * block.down.y[i] + axis.z * block.down.z[i];
  }
}

// Shares of the object's axes, as addHeldTaps; `normal` is zero where there is none.
template <class Space>
__attribute__((always_inline)) inline void weighAlong(const StrokeCentre& centre,
                                                      const Space& space, float near, int count,
                                                      BrushBlock& block) {
  const V3f v = centre.axis;
  const float *__restrict nx = block.normalX, *__restrict ny = block.normalY,
                          *__restrict nz = block.normalZ;
  float* __restrict w0 = block.weight[0], * __restrict w1 = block.weight[1], * __restrict w2 = block.weight[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const V3f t = directionRound(v, space.from(centre, i), nx[i], ny[i], nz[i]);
    const float alongA = space.along(0, t.x, t.y, t.z);
    const float alongB = space.along(1, t.x, t.y, t.z);
    const float alongC = space.along(2, t.x, t.y, t.z);
    const float partA = near * near + alongA * alongA, partB = near * near + alongB * alongB,
                partC = near * near + alongC * alongC;
    const float largerAB = partA > partB ? partA : partB;
    const float largest = partC > largerAB ? partC : largerAB;
    const float moreA = partA / largest - axisThreshold, moreB = partB / largest - axisThreshold,
                moreC = partC / largest - axisThreshold;
    const float positiveA = moreA > 0.0f ? moreA : 0.0f, positiveB = moreB > 0.0f ? moreB : 0.0f,
                positiveC = moreC > 0.0f ? moreC : 0.0f;
    const float weightA = positiveA * positiveA, weightB = positiveB * positiveB,
                weightC = positiveC * positiveC;
    const float total = weightA + weightB + weightC;
    w0[i] = weightA / total;
    w1[i] = weightB / total;
    w2[i] = weightC / total;
  }
}

KAGEFUDE_CLONES
void weighObjectAxes(const StrokeCentre& centre, const ObjectAxes& object, float near, int count,
                     BrushBlock& block) {
  weighAlong(centre, WorldSpace(block, object), near, count, block);
}

KAGEFUDE_CLONES
void weighRestAxes(const StrokeCentre& centre, float near, int count, BrushBlock& block) {
  weighAlong(centre, RestSpace(block), near, count, block);
}

// Turns shares into weights that keep the contrast (or not), and finds the row mean's.
KAGEFUDE_CLONES
void gainContrast(float contrast, float octaves, float keep, int count, BrushBlock& block) {
  float *__restrict w0 = block.weight[0], *__restrict w1 = block.weight[1],
                    *__restrict w2 = block.weight[2], *__restrict mean = block.meanGain;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float squares = w0[i] * w0[i] + w1[i] * w1[i] + w2[i] * w2[i];
    const float kept = contrast / std::sqrt(squares * octaves);
    const float gain = keep > 0.0f ? kept : contrast;
    w0[i] *= gain;
    w1[i] *= gain;
    w2[i] *= gain;
    mean[i] = 1.0f - gain;
  }
}

// Asks for what the next row's block reads first: so many planes are read side by side, and so
// briefly each, that the processor does not foresee it.
template <class T>
void fetchAhead(const View<const T>& plane, int first, int end, int y) {
  constexpr int line = 64 / sizeof(T);
  const T* row = plane.row(std::min(y, plane.height - 1));
  for (int x = first; x < end; x += line) __builtin_prefetch(row + x, 0, 2);
}

void fetchNextBlock(const BrushInput& in, bool atRest, int first, int end, int y) {
  for (const View<const float>& plane : {in.position.x, in.position.y, in.position.z, in.tone})
    fetchAhead(plane, first, end, y + 2);
  fetchAhead(in.index, first, end, y + 2);
  if (atRest)
    for (const View<const float>& plane : {in.rest.x, in.rest.y, in.rest.z})
      fetchAhead(plane, first, end, y + 2);
  if (in.normal.empty()) return;
  for (const View<const float>& plane : {in.normal.x, in.normal.y, in.normal.z})
    fetchAhead(plane, first, end, y + 1);
}

}  // namespace

void loadBlock(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
               BrushBlock& block) {
  const int count = end - first;
  const uint16_t own = in.index(first, y);
  const bool atRest = liesAtRest(in, anchor);
  fetchNextBlock(in, atRest, first, end, y);
  loadLine(in, first, end, y - 1, own, block.above);
  loadLine(in, first, end, y, own, block.here);
  loadLine(in, first, end, y + 1, own, block.below);
  if (in.normal.empty()) {
    for (float* plane : {block.normalX, block.normalY, block.normalZ})
      std::fill_n(plane, count, 0.0f);
  } else {
    unitNormals(in.normal.x.row(y) + first, in.normal.y.row(y) + first, in.normal.z.row(y) + first,
                count, block);
  }
  changes(block.here, block.here, 2, block.here, 0, count, block.across);
  changes(block.here, block.below, 1, block.above, 1, count, block.down);
  if (atRest) return loadRest(in, anchor.object, first, end, y, block);
  const V3f axes[3] = {anchor.object.x, anchor.object.y, anchor.object.z};
  for (int k = 0; k < 3; ++k) placesAlong(axes[k], anchor.object.origin, count, k, block);
}

void prepareBlock(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  BrushBlock& block) {
  loadBlock(in, anchor, first, end, y, block);
  const int count = end - first;
  const float finer = 1.0f - anchor.coarser;
  const bool atRest = liesAtRest(in, anchor);
  const StrokeCentre centre = strokeCentre(anchor, anchor.points[0], atRest);
  const float near = heldNearAxis * anchor.mappingDistance * (1.0f + anchor.coarser);
  if (atRest)
    weighRestAxes(centre, near, count, block);
  else
    weighObjectAxes(centre, anchor.object, near, count, block);
  gainContrast(in.params.contrast, finer * finer + anchor.coarser * anchor.coarser,
               in.params.crossFade == BrushParams::CrossFade::variance ? 1.0f : 0.0f, count, block);
}

}  // namespace kagefude
