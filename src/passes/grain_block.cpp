#include "passes/grain_block.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush_taps.h"

namespace kagefude {
namespace {

/// Squared parts of the strokes' direction along the object's axes.
struct Parts {
  alignas(64) float along[3][brushBlock];
};

// Adds the parts round one reference point, weighed by `share`, as strokeParts.
KAGEFUDE_CLONES
void addParts(V3f v, V3f g, const ObjectAxes& object, const float* __restrict share, int count,
              const BrushBlock& block, Parts& parts) {
  const V3f a = object.x, b = object.y, c = object.z;
  const float *__restrict px = block.here.x + 1, *__restrict py = block.here.y + 1,
                          *__restrict pz = block.here.z + 1;
  const float *__restrict nx = block.normalX, *__restrict ny = block.normalY,
                          *__restrict nz = block.normalZ;
  float* __restrict pa = parts.along[0], * __restrict pb = parts.along[1], * __restrict pc = parts.along[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float x = px[i] - g.x, y = py[i] - g.y, z = pz[i] - g.z;
    const float rx = v.y * z - v.z * y, ry = v.z * x - v.x * z, rz = v.x * y - v.y * x;
    const float off = nx[i] * rx + ny[i] * ry + nz[i] * rz;
    const float tx = rx - nx[i] * off, ty = ry - ny[i] * off, tz = rz - nz[i] * off;
    const float alongA = tx * a.x + ty * a.y + tz * a.z;
    const float alongB = tx * b.x + ty * b.y + tz * b.z;
    const float alongC = tx * c.x + ty * c.y + tz * c.z;
    pa[i] += share[i] * alongA * alongA;
    pb[i] += share[i] * alongB * alongB;
    pc[i] += share[i] * alongC * alongC;
  }
}

// Share of everything beyond the gap from reference point j to j + 1, as brushPlace.
KAGEFUDE_CLONES
void shareBeyond(const BrushAnchor& anchor, float from, float to, float blend, int count,
                 const BrushBlock& block, float* __restrict share) {
  const V3f side = anchor.longSide, origin = anchor.object.origin;
  const float *__restrict px = block.here.x + 1, *__restrict py = block.here.y + 1,
                          *__restrict pz = block.here.z + 1;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float along =
        side.x * (px[i] - origin.x) + side.y * (py[i] - origin.y) + side.z * (pz[i] - origin.z);
    const float t = ((along - from) / (to - from) - 0.5f) / blend + 0.5f;
    const float above = t > 0.0f ? t : 0.0f;
    const float c = above < 1.0f ? above : 1.0f;
    share[i] = c * c * (3.0f - 2.0f * c);
  }
}

void findParts(const BrushInput& in, const BrushAnchor& anchor, int count, const BrushBlock& block,
               Parts& parts) {
  const float near = objectNearAxis * anchor.mappingDistance * (1.0f + anchor.coarser);
  for (auto& along : parts.along) std::fill_n(along, count, near * near);
  alignas(64) float before[brushBlock], beyond[brushBlock], share[brushBlock];
  std::fill_n(before, count, 1.0f);
  for (size_t j = 0; j < anchor.points.size(); ++j) {
    const bool last = j + 1 == anchor.points.size();
    std::fill_n(beyond, count, 0.0f);
    if (!last && anchor.points[j + 1].along > anchor.points[j].along)
      shareBeyond(anchor, anchor.points[j].along, anchor.points[j + 1].along, in.params.pointBlend,
                  count, block, beyond);
    for (int i = 0; i < count; ++i) share[i] = before[i] * (1.0f - beyond[i]);
    addParts(anchor.points[j].frame.axis, anchor.points[j].position, anchor.object, share, count,
             block, parts);
    std::copy_n(beyond, count, before);
  }
}

// How much the surface faces each axis; where no normal is known, by its positions.
KAGEFUDE_CLONES
void findFaces(const ObjectAxes& object, int count, const BrushBlock& block, GrainTaps& taps) {
  const V3f a = object.x, b = object.y, c = object.z;
  float* __restrict fa = taps.faces[0], * __restrict fb = taps.faces[1], * __restrict fc = taps.faces[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float x = block.normalX[i], y = block.normalY[i], z = block.normalZ[i];
    const float dx = block.across.x[i], dy = block.across.y[i], dz = block.across.z[i];
    const float ex = block.down.x[i], ey = block.down.y[i], ez = block.down.z[i];
    const bool known = x * x + y * y + z * z > 0.0f;
    const float nx = known ? x : dy * ez - dz * ey;
    const float ny = known ? y : dz * ex - dx * ez;
    const float nz = known ? z : dx * ey - dy * ex;
    const float onA = nx * a.x + ny * a.y + nz * a.z, onB = nx * b.x + ny * b.y + nz * b.z,
                onC = nx * c.x + ny * c.y + nz * c.z;
    const float faceA = onA * onA + leastFacing, faceB = onB * onB + leastFacing,
                faceC = onC * onC + leastFacing;
    const float largerAB = faceA > faceB ? faceA : faceB;
    const float largest = faceC > largerAB ? faceC : largerAB;
    fa[i] = excessShare(faceA, largest);
    fb[i] = excessShare(faceB, largest);
    fc[i] = excessShare(faceC, largest);
  }
}

// In the plane that faces axis k, the share of strokes along axis k + 1 (the rest: k + 2).
KAGEFUDE_CLONES
void findDirections(const float* __restrict first, const float* __restrict second, int count,
                    float* __restrict alongFirst) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float larger = first[i] > second[i] ? first[i] : second[i];
    const float one = excessShare(first[i], larger), other = excessShare(second[i], larger);
    alongFirst[i] = one / (one + other);
  }
}

/// What turns a block's places into places on the grain, for one octave.
struct GrainUnits {
  float u = 0, across = 0, shift = 0, share = 1;
};

// Gains, the number of patterns, and the weightiest tap of each pixel.
KAGEFUDE_CLONES
void listFirstTaps(const GrainUnits& units, float octaves, float keep, int count,
                   const BrushBlock& block, GrainTaps& taps) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float fa = taps.faces[0][i], fb = taps.faces[1][i], fc = taps.faces[2][i];
    const float da = taps.alongFirst[0][i], db = taps.alongFirst[1][i], dc = taps.alongFirst[2][i];
    const float ra = 1.0f - da, rb = 1.0f - db, rc = 1.0f - dc;
    const float sum = fa + fb + fc;
    const float squares = fa * fa * (da * da + ra * ra) + fb * fb * (db * db + rb * rb) +
                          fc * fc * (dc * dc + rc * rc);
    const float kept = 1.0f / std::sqrt(squares * octaves);
    const float gain = keep > 0.0f ? kept : 1.0f / sum;
    const int inA = (da > 0.0f ? 1 : 0) + (ra > 0.0f ? 1 : 0),
              inB = (db > 0.0f ? 1 : 0) + (rb > 0.0f ? 1 : 0),
              inC = (dc > 0.0f ? 1 : 0) + (rc > 0.0f ? 1 : 0);
    taps.gain[i] = gain;
    taps.patterns[i] = (fa > 0.0f ? inA : 0) + (fb > 0.0f ? inB : 0) + (fc > 0.0f ? inC : 0);
    // The plane's two axes, and which of them the strokes run along.
    const bool onA = fa >= fb && fa >= fc, onB = !onA && fb >= fc;
    const float share = onA ? da : (onB ? db : dc);
    const bool first = share >= 0.5f;
    const float face = onA ? fa : (onB ? fb : fc);
    const float* __restrict p0 = block.place[0], * __restrict p1 = block.place[1],
                 * __restrict p2 = block.place[2];
    const float *__restrict x0 = block.placeAcross[0], *__restrict x1 = block.placeAcross[1],
                            *__restrict x2 = block.placeAcross[2];
    const float *__restrict y0 = block.placeDown[0], *__restrict y1 = block.placeDown[1],
                            *__restrict y2 = block.placeDown[2];
    const float pf = onA ? p1[i] : (onB ? p2[i] : p0[i]), ps = onA ? p2[i] : (onB ? p0[i] : p1[i]);
    const float xf = onA ? x1[i] : (onB ? x2[i] : x0[i]), xs = onA ? x2[i] : (onB ? x0[i] : x1[i]);
    const float yf = onA ? y1[i] : (onB ? y2[i] : y0[i]), ys = onA ? y2[i] : (onB ? y0[i] : y1[i]);
    const float of = onA ? axisOffset[1] : (onB ? axisOffset[2] : axisOffset[0]);
    const float os = onA ? axisOffset[2] : (onB ? axisOffset[0] : axisOffset[1]);
    const float ok = onA ? axisOffset[0] : (onB ? axisOffset[1] : axisOffset[2]);
    taps.u[i] = (first ? pf : ps) * units.u + ((first ? of : os) + units.shift);
    taps.across[i] = (first ? ps : pf) * units.across + ok;
    taps.ux[i] = (first ? xf : xs) * units.u;
    taps.uy[i] = (first ? yf : ys) * units.u;
    taps.vx[i] = (first ? xs : xf) * units.across;
    taps.vy[i] = (first ? ys : yf) * units.across;
    taps.weight[i] = face * (first ? share : 1.0f - share) * gain * units.share;
  }
}

// One more pattern of a pixel: strokes along axis i, across axis j, in the plane facing axis k.
void addTap(const BrushBlock& block, const GrainUnits& units, int pixel, int i, int j, int k,
            float weight, GrainTaps& taps) {
  const int n = taps.count++;
  taps.pixel[n] = pixel;
  taps.u[n] = block.place[i][pixel] * units.u + (axisOffset[i] + units.shift);
  taps.across[n] = block.place[j][pixel] * units.across + axisOffset[k];
  taps.ux[n] = block.placeAcross[i][pixel] * units.u;
  taps.uy[n] = block.placeDown[i][pixel] * units.u;
  taps.vx[n] = block.placeAcross[j][pixel] * units.across;
  taps.vy[n] = block.placeDown[j][pixel] * units.across;
  taps.weight[n] = weight * units.share;
}

// All patterns of a pixel but, with `skipFirst`, the weightiest.
void addTaps(const BrushBlock& block, const GrainUnits& units, int pixel, bool skipFirst,
             GrainTaps& taps) {
  const float faces[3] = {taps.faces[0][pixel], taps.faces[1][pixel], taps.faces[2][pixel]};
  const int plane = faces[0] >= faces[1] && faces[0] >= faces[2] ? 0 : faces[1] >= faces[2] ? 1 : 2;
  for (int k = 0; k < 3; ++k) {
    if (!(faces[k] > 0.0f)) continue;
    const int axis[2] = {(k + 1) % 3, (k + 2) % 3};
    const float share[2] = {taps.alongFirst[k][pixel], 1.0f - taps.alongFirst[k][pixel]};
    const int weightiest = share[0] >= 0.5f ? 0 : 1;
    for (int side = 0; side < 2; ++side)
      if (share[side] > 0.0f && !(skipFirst && k == plane && side == weightiest))
        addTap(block, units, pixel, axis[side], axis[1 - side], k,
               faces[k] * share[side] * taps.gain[pixel], taps);
  }
}

}  // namespace

void listGrainTaps(const BrushInput& in, const BrushAnchor& anchor, float aspect, int count,
                   const BrushBlock& block, GrainTaps& taps) {
  Parts parts;
  findParts(in, anchor, count, block, parts);
  findFaces(anchor.object, count, block, taps);
  for (int k = 0; k < 3; ++k)
    findDirections(parts.along[(k + 1) % 3], parts.along[(k + 2) % 3], count, taps.alongFirst[k]);
  const float perUnit = 1.0f / (2.0f * pi * anchor.mappingDistance);
  const float finer = 1.0f - anchor.coarser,
              squares = finer * finer + anchor.coarser * anchor.coarser;
  const GrainUnits fine{perUnit, perUnit * aspect, anchor.shift, finer};
  const GrainUnits coarse{0.5f * perUnit, 0.5f * perUnit * aspect, anchor.coarserShift,
                          anchor.coarser};
  const GrainUnits& first = finer > 0.0f ? fine : coarse;
  const bool keep = in.params.crossFade == BrushParams::CrossFade::variance;
  listFirstTaps(first, squares, keep ? 1.0f : 0.0f, count, block, taps);
  taps.pixels = taps.count = count;
  const bool both = finer > 0.0f && anchor.coarser > 0.0f;
  for (int i = 0; i < count; ++i) {
    if (taps.patterns[i] > 1) addTaps(block, first, i, true, taps);
    if (both) addTaps(block, coarse, i, false, taps);
  }
}

}  // namespace kagefude
