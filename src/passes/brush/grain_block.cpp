#include "passes/brush/grain_block.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush/block_space.h"
#include "passes/brush/brush_taps.h"

namespace kagefude {
namespace {

/// Squared parts of the strokes' direction along the object's axes.
struct Parts {
  alignas(64) float along[3][brushBlock];
};

// Adds the parts round one reference point, weighed by `share`, as strokeParts.
template <class Space>
__attribute__((always_inline)) inline void addPartsAlong(const StrokeCentre& centre,
                                                         const Space& space,
                                                         const float* __restrict share, int count,
                                                         const BrushBlock& block, Parts& parts) {
  const V3f v = centre.axis;
  const float *__restrict nx = block.normalX, *__restrict ny = block.normalY,
                          *__restrict nz = block.normalZ;
  float* __restrict pa = parts.along[0], * __restrict pb = parts.along[1], * __restrict pc = parts.along[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const V3f t = directionRound(v, space.from(centre, i), nx[i], ny[i], nz[i]);
    const float alongA = space.along(0, t.x, t.y, t.z);
    const float alongB = space.along(1, t.x, t.y, t.z);
    const float alongC = space.along(2, t.x, t.y, t.z);
    pa[i] += share[i] * alongA * alongA;
    pb[i] += share[i] * alongB * alongB;
    pc[i] += share[i] * alongC * alongC;
  }
}

KAGEFUDE_CLONES
void addObjectParts(const StrokeCentre& centre, const ObjectAxes& object, const float* share,
                    int count, const BrushBlock& block, Parts& parts) {
  addPartsAlong(centre, WorldSpace(block, object), share, count, block, parts);
}

KAGEFUDE_CLONES
void addRestParts(const StrokeCentre& centre, const float* share, int count,
                  const BrushBlock& block, Parts& parts) {
  addPartsAlong(centre, RestSpace(block), share, count, block, parts);
}

// Places on the anchor's long side.
KAGEFUDE_CLONES
void findAlong(V3f side, V3f origin, int count, const BrushBlock& block, float* __restrict along) {
  const float *__restrict px = block.here.x + 1, *__restrict py = block.here.y + 1,
                          *__restrict pz = block.here.z + 1;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
    along[i] =
        side.x * (px[i] - origin.x) + side.y * (py[i] - origin.y) + side.z * (pz[i] - origin.z);
}

KAGEFUDE_CLONES
void findAlongAtRest(V3f side, int count, const BrushBlock& block, float* __restrict along) {
  const float *__restrict px = block.place[0], *__restrict py = block.place[1],
                          *__restrict pz = block.place[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) along[i] = side.x * px[i] + side.y * py[i] + side.z * pz[i];
}

// Share of everything beyond the gap from reference point j to j + 1, as brushPlace.
KAGEFUDE_CLONES
void shareBeyond(const float* __restrict along, float from, float to, float blend, int count,
                 float* __restrict share) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float t = ((along[i] - from) / (to - from) - 0.5f) / blend + 0.5f;
    const float above = t > 0.0f ? t : 0.0f;
    const float c = above < 1.0f ? above : 1.0f;
    share[i] = c * c * (3.0f - 2.0f * c);
  }
}

void findParts(const BrushInput& in, const BrushAnchor& anchor, int count, const BrushBlock& block,
               Parts& parts) {
  const float near = objectNearAxis * anchor.mappingDistance * (1.0f + anchor.coarser);
  for (auto& along : parts.along) std::fill_n(along, count, near * near);
  alignas(64) float before[brushBlock], beyond[brushBlock], share[brushBlock], along[brushBlock];
  const bool atRest = liesAtRest(in, anchor);
  if (anchor.points.size() > 1 && atRest)
    findAlongAtRest(alongAxes(anchor.object, anchor.longSide), count, block, along);
  else if (anchor.points.size() > 1)
    findAlong(anchor.longSide, anchor.object.origin, count, block, along);
  std::fill_n(before, count, 1.0f);
  for (size_t j = 0; j < anchor.points.size(); ++j) {
    const bool last = j + 1 == anchor.points.size();
    std::fill_n(beyond, count, 0.0f);
    if (!last && anchor.points[j + 1].along > anchor.points[j].along)
      shareBeyond(along, anchor.points[j].along, anchor.points[j + 1].along, in.params.pointBlend,
                  count, beyond);
    for (int i = 0; i < count; ++i) share[i] = before[i] * (1.0f - beyond[i]);
    const StrokeCentre centre = strokeCentre(anchor, anchor.points[j], atRest);
    if (atRest)
      addRestParts(centre, share, count, block, parts);
    else
      addObjectParts(centre, anchor.object, share, count, block, parts);
    std::copy_n(beyond, count, before);
  }
}

// Of the strokes in a plane, the share along its first axis.
inline float shareOfFirst(float first, float second) {
  const float larger = first > second ? first : second;
  const float one = excessShare(first, larger), other = excessShare(second, larger);
  return one / (one + other);
}

// How much the surface faces each axis; where no normal is known, by its positions.
template <class Space>
__attribute__((always_inline)) inline void findFacesAlong(const Space& space, int count,
                                                          const BrushBlock& block,
                                                          GrainTaps& taps) {
  float* __restrict fa = taps.faces[0], * __restrict fb = taps.faces[1], * __restrict fc = taps.faces[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float x = block.normalX[i], y = block.normalY[i], z = block.normalZ[i];
    const float dx = space.across[0][i], dy = space.across[1][i], dz = space.across[2][i];
    const float ex = space.down[0][i], ey = space.down[1][i], ez = space.down[2][i];
    const bool known = x * x + y * y + z * z > 0.0f;
    const float nx = known ? x : dy * ez - dz * ey;
    const float ny = known ? y : dz * ex - dx * ez;
    const float nz = known ? z : dx * ey - dy * ex;
    const float onA = space.along(0, nx, ny, nz), onB = space.along(1, nx, ny, nz),
                onC = space.along(2, nx, ny, nz);
    const float faceA = onA * onA + leastFacing, faceB = onB * onB + leastFacing,
                faceC = onC * onC + leastFacing;
    const float largerAB = faceA > faceB ? faceA : faceB;
    const float largest = faceC > largerAB ? faceC : largerAB;
    fa[i] = excessShare(faceA, largest);
    fb[i] = excessShare(faceB, largest);
    fc[i] = excessShare(faceC, largest);
  }
}

KAGEFUDE_CLONES
void findObjectFaces(const ObjectAxes& object, int count, const BrushBlock& block,
                     GrainTaps& taps) {
  findFacesAlong(WorldSpace(block, object), count, block, taps);
}

KAGEFUDE_CLONES
void findRestFaces(int count, const BrushBlock& block, GrainTaps& taps) {
  findFacesAlong(RestSpace(block), count, block, taps);
}

/// What turns a block's places into places on the grain, for one octave.
struct GrainUnits {
  float u = 0, across = 0, shift = 0, share = 1;
};

// Weights of the six patterns: the plane that faces axis k with strokes along either of its axes.
KAGEFUDE_CLONES
void weighPatterns(const Parts& parts, float octaves, float keep, int count, GrainTaps& taps) {
  const float *__restrict pa = parts.along[0], *__restrict pb = parts.along[1],
                          *__restrict pc = parts.along[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float fa = taps.faces[0][i], fb = taps.faces[1][i], fc = taps.faces[2][i];
    const float da = shareOfFirst(pb[i], pc[i]), db = shareOfFirst(pc[i], pa[i]),
                dc = shareOfFirst(pa[i], pb[i]);
    const float ra = 1.0f - da, rb = 1.0f - db, rc = 1.0f - dc;
    const float squares = fa * fa * (da * da + ra * ra) + fb * fb * (db * db + rb * rb) +
                          fc * fc * (dc * dc + rc * rc);
    const float divisor = keep > 0.0f ? std::sqrt(squares * octaves) : fa + fb + fc;
    const float gain = 1.0f / divisor;
    const float ga = fa * gain, gb = fb * gain, gc = fc * gain;
    const float a0 = ga * da, a1 = ga * ra, b0 = gb * db, b1 = gb * rb, c0 = gc * dc, c1 = gc * rc;
    taps.share[0][0][i] = a0;
    taps.share[0][1][i] = a1;
    taps.share[1][0][i] = b0;
    taps.share[1][1][i] = b1;
    taps.share[2][0][i] = c0;
    taps.share[2][1][i] = c1;
    taps.patterns[i] = (a0 > 0.0f ? 1 : 0) | (a1 > 0.0f ? 2 : 0) | (b0 > 0.0f ? 4 : 0) |
                       (b1 > 0.0f ? 8 : 0) | (c0 > 0.0f ? 16 : 0) | (c1 > 0.0f ? 32 : 0);
  }
}

// One pattern of a group of pixels: strokes along axis i, across axis j, in the plane facing axis
// k.
KAGEFUDE_CLONES
void fillTaps(const BrushBlock& block, const GrainUnits& units, int pixel, int i, int j, int k,
              const float* __restrict share, GrainTaps& taps) {
  const int n = taps.count;
  const float shift = axisOffset[i] + units.shift, shiftAcross = axisOffset[k];
  const float* __restrict placeI = block.place[i] + pixel, * __restrict placeJ =
                                                               block.place[j] + pixel;
  const float* __restrict acrossI = block.placeAcross[i] + pixel, * __restrict acrossJ =
                                                                      block.placeAcross[j] + pixel;
  const float* __restrict downI = block.placeDown[i] + pixel, * __restrict downJ =
                                                                  block.placeDown[j] + pixel;
#pragma GCC ivdep
  for (int l = 0; l < grainLanes; ++l) {
    taps.u[n + l] = placeI[l] * units.u + shift;
    taps.across[n + l] = placeJ[l] * units.across + shiftAcross;
    taps.ux[n + l] = acrossI[l] * units.u;
    taps.uy[n + l] = downI[l] * units.u;
    taps.vx[n + l] = acrossJ[l] * units.across;
    taps.vy[n + l] = downJ[l] * units.across;
    taps.weight[n + l] = share[l] * units.share;
  }
}

// All patterns of a group of pixels.
void addTaps(const BrushBlock& block, const GrainUnits& units, int pixel, GrainTaps& taps) {
  const int patterns = bitsOf(taps.patterns + pixel);
  for (int k = 0; k < 3; ++k)
    for (int side = 0; side < 2; ++side) {
      if (!(patterns >> (2 * k + side) & 1)) continue;
      fillTaps(block, units, pixel, (k + 1 + side) % 3, (k + 2 - side) % 3, k,
               taps.share[k][side] + pixel, taps);
      taps.pixel[taps.count / grainLanes] = pixel;
      taps.count += grainLanes;
    }
}

// Makes the last group whole, with pixels that no pattern touches.
void padGroup(int count, BrushBlock& block, GrainTaps& taps) {
  const int rest = (grainLanes - count % grainLanes) % grainLanes;
  for (int k = 0; k < 3; ++k) {
    for (float* row : {block.place[k], block.placeAcross[k], block.placeDown[k], taps.share[k][0],
                       taps.share[k][1]})
      std::fill_n(row + count, rest, 0.0f);
  }
  std::fill_n(taps.patterns + count, rest, 0);
}

}  // namespace

void listGrainTaps(const BrushInput& in, const BrushAnchor& anchor, float aspect, int count,
                   BrushBlock& block, GrainTaps& taps) {
  Parts parts;
  findParts(in, anchor, count, block, parts);
  if (liesAtRest(in, anchor))
    findRestFaces(count, block, taps);
  else
    findObjectFaces(anchor.object, count, block, taps);
  const float perUnit = 1.0f / (2.0f * pi * anchor.mappingDistance);
  const float finer = 1.0f - anchor.coarser,
              squares = finer * finer + anchor.coarser * anchor.coarser;
  const GrainUnits fine{perUnit, perUnit * aspect, anchor.shift, finer};
  const GrainUnits coarse{0.5f * perUnit, 0.5f * perUnit * aspect, anchor.coarserShift,
                          anchor.coarser};
  const bool keep = in.params.crossFade == BrushParams::CrossFade::variance;
  weighPatterns(parts, squares, keep ? 1.0f : 0.0f, count, taps);
  padGroup(count, block, taps);
  taps.count = 0;
  for (int pixel = 0; pixel < count; pixel += grainLanes) {
    if (finer > 0.0f) addTaps(block, fine, pixel, taps);
    if (anchor.coarser > 0.0f) addTaps(block, coarse, pixel, taps);
  }
}

}  // namespace kagefude
