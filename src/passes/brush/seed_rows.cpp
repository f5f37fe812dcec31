#include "passes/brush/seed_rows.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush/brush_block.h"
#include "passes/brush/brush_repeat.h"
#include "passes/strip/strip_lookup.h"

namespace kagefude {
namespace {

/// Places of a block's lookups in the strip's full-size level.
struct SeedPlaces {
  alignas(64) float u[2][brushBlock], next[brushBlock];
  alignas(64) int texel[2][brushBlock], right[2][brushBlock], down[brushBlock];
  alignas(64) float fx[2][brushBlock], fy[brushBlock];
  alignas(64) int present[brushBlock];
};

// The seed's angle and rings, as addSeedTaps.
KAGEFUDE_CLONES
void findTurns(const float* __restrict px, const float* __restrict py, const float* __restrict pz,
               V3f l1, V3f l2, V3f g, float mappingDistance, int count, float* __restrict angle,
               float* __restrict rings, int* __restrict present) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float x = px[i] - g.x, y = py[i] - g.y, z = pz[i] - g.z;
    const float a = l1.x * x + l1.y * y + l1.z * z, b = l2.x * x + l2.y * y + l2.z * z;
    const float sum = px[i] + py[i] + pz[i];
    angle[i] = turnsOf(a, b);
    rings[i] = std::sqrt(a * a + b * b) / mappingDistance;
    present[i] = sum - sum == 0.0f ? 1 : 0;
  }
}

KAGEFUDE_CLONES
void findRepeats(const float* __restrict angle, const float* __restrict rings, float blendWidth,
                 int count, SeedPlaces& places) {
  const float blends = blendWidth > 0.0f ? 1.0f : 0.0f;
  const float width = blendWidth > 0.0f ? blendWidth : 1.0f;
  float* __restrict u0 = places.u[0], * __restrict u1 = places.u[1], * __restrict next = places.next;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float repeats = std::floor(rings[i]);
    const float fraction = rings[i] - repeats;
    const float blended = ((fraction - 1.0f) / width + 1.0f) * blends;
    next[i] = fraction >= 1.0f - width ? blended : 0.0f;
    u0[i] = fractionOf(angle[i] * repeats);
    u1[i] = fractionOf(angle[i] * (repeats + 1.0f));
  }
}

KAGEFUDE_CLONES
void findColumns(const float* __restrict u, int width, int count, int* __restrict texel,
                 int* __restrict right, float* __restrict fx) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const ColumnPlace column = columnPlace(u[i], width);
    texel[i] = column.left;
    right[i] = column.right - column.left;
    fx[i] = column.fraction;
  }
}

KAGEFUDE_CLONES
void findRows(const float* __restrict tone, int width, int height, int count, SeedPlaces& places) {
  int *__restrict first = places.texel[0], *__restrict second = places.texel[1],
                  *__restrict down = places.down;
  float* __restrict fy = places.fy;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const RowPlace row = rowPlace(clampedUnit(tone[i]), height);
    first[i] += row.upper * width;
    second[i] += row.upper * width;
    down[i] = (row.lower - row.upper) * width;
    fy[i] = row.fraction;
  }
}

Rgba lookUpAt(const Rgba* texels, const SeedPlaces& places, int which, int i) {
  const Rgba* upper = texels + places.texel[which][i];
  const Rgba* lower = upper + places.down[i];
  const int right = places.right[which][i];
  return mixFour(upper[0], upper[right], lower[0], lower[right], places.fx[which][i], places.fy[i]);
}

// Asks for texels ahead: a strip is far larger than the caches, and places jump.
void fetchAhead(const Rgba* texels, const SeedPlaces& places, int i) {
  for (int which = 0; which < 2; ++which) {
    if (which == 1 && places.next[i] == 0.0f) return;
    __builtin_prefetch(texels + places.texel[which][i]);
    __builtin_prefetch(texels + places.texel[which][i] + places.down[i]);
  }
}

Rgba colourAt(const Rgba* texels, const SeedPlaces& places, int i) {
  const float next = places.next[i];
  Rgba colour = lookUpAt(texels, places, 0, i);
  if (next != 0.0f) colour = colour * (1.0f - next) + lookUpAt(texels, places, 1, i) * next;
  return places.present[i] ? colour : Rgba{};
}

void storeSeed(const Rgba* texels, const SeedPlaces& places, int first, int count,
               ColourRows& out) {
  constexpr int ahead = 12;
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    Rgba four[4];
    for (int k = 0; k < 4; ++k) {
      if (i + k + ahead < count) fetchAhead(texels, places, i + k + ahead);
      four[k] = colourAt(texels, places, i + k);
    }
    out.storeFour(first + i, four);
  }
  for (; i < count; ++i) out.store(first + i, colourAt(texels, places, i));
}

}  // namespace

bool canPaintSeedRow(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.mapping == BrushParams::Mapping::seed && anchor.points.size() == 1 &&
         !liesAtRest(in, anchor);
}

void paintSeedRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  ColourRows& out) {
  const Strip::Level& full = in.strips[static_cast<size_t>(anchor.strip)].levels.front();
  const BrushAnchor::Point& point = anchor.points.front();
  SeedPlaces places;
  alignas(64) float angle[brushBlock], rings[brushBlock];
  for (int x = first; x < end; x += brushBlock) {
    const int count = std::min(end - x, brushBlock);
    findTurns(in.position.x.row(y) + x, in.position.y.row(y) + x, in.position.z.row(y) + x,
              point.frame.l1, point.frame.l2, point.position, anchor.mappingDistance, count, angle,
              rings, places.present);
    findRepeats(angle, rings, in.params.blendWidth, count, places);
    for (int which = 0; which < 2; ++which)
      findColumns(places.u[which], full.width, count, places.texel[which], places.right[which],
                  places.fx[which]);
    findRows(in.tone.row(y) + x, full.width, full.height, count, places);
    storeSeed(full.texels.row(0), places, x, count, out);
  }
}

}  // namespace kagefude
