#include <algorithm>
#include <cmath>
#include <memory>

#include "image/clones.h"
#include "passes/grain_block.h"
#include "passes/grain_lookup.h"

namespace kagefude {
namespace {

/// Sizes of the grain's levels in arrays, and its texels.
struct LevelSizes {
  static constexpr int most = 16;
  int width[most], height[most], offset[most];
  int last = 0;
  const uint8_t* pool = nullptr;

  explicit LevelSizes(const StripGrain& grain)
      : last(static_cast<int>(grain.levels.size()) - 1), pool(grain.pool.row(0)) {
    for (int i = 0; i <= last; ++i) {
      const StripGrain::Level& level = grain.levels[static_cast<size_t>(i)];
      width[i] = level.width;
      height[i] = level.height;
      offset[i] = level.offset;
    }
  }
};

KAGEFUDE_CLONES
void splitTaps(float w, float h, float maxProbes, int lastLevel, GrainTaps& taps) {
  const float most = static_cast<float>(lastLevel);
  float* __restrict coarser = taps.coarser, * __restrict stepU = taps.stepU, * __restrict stepV = taps.stepV;
  int* __restrict probes = taps.probes, * __restrict level = taps.level;
  const int count = taps.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    float n, lod, du, dv;
    grainEllipse(taps.ux[i] * w, taps.vx[i] * h, taps.uy[i] * w, taps.vy[i] * h, w, h, maxProbes, n,
                 lod, du, dv);
    const float between = lod < most ? lod : most;
    const int fine = static_cast<int>(between);
    const float share = levelShare(between - static_cast<float>(fine));
    probes[i] = static_cast<int>(n);
    level[i] = fine + (share >= 1.0f ? 1 : 0);
    coarser[i] = share >= 1.0f ? 0.0f : share;
    stepU[i] = du;
    stepV[i] = dv;
  }
}

/// Lookups of single levels, at most a few per tap.
struct Lookups {
  static constexpr int most = 512;
  int count = 0;
  alignas(64) float u[most], across[most], weight[most], value[most];
  alignas(64) int level[most];
  int tap[most];
};

/// Loops of their own, or the compiler keeps branches and plain registers.
KAGEFUDE_CLONES
void wrapPlaces(const float* __restrict places, float scale, int count, float* __restrict wrapped) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) wrapped[i] = fractionOf(places[i] * scale);
}

/// Where lookups lie, and the texels found there.
struct Found {
  alignas(64) int texel[Lookups::most];
  alignas(64) float fx[Lookups::most], fy[Lookups::most];
  alignas(64) uint32_t four[Lookups::most];
};

KAGEFUDE_CLONES
void placeInLevels(const LevelSizes& sizes, const float* __restrict u,
                   const float* __restrict across, const int* __restrict level, int count,
                   Found& found) {
  int* __restrict texel = found.texel;
  float* __restrict fx = found.fx, * __restrict fy = found.fy;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const int l = level[i];
    const GrainPlace place =
        grainPlace(u[i], across[i], sizes.width[l], sizes.height[l], sizes.offset[l]);
    texel[i] = place.texel;
    fx[i] = place.fx;
    fy[i] = place.fy;
  }
}

KAGEFUDE_CLONES
void placeInLevel(int width, int height, int offset, const float* __restrict u,
                  const float* __restrict across, int count, Found& found) {
  int* __restrict texel = found.texel;
  float* __restrict fx = found.fx, * __restrict fy = found.fy;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const GrainPlace place = grainPlace(u[i], across[i], width, height, offset);
    texel[i] = place.texel;
    fx[i] = place.fx;
    fy[i] = place.fy;
  }
}

// One by one: gathering in vector registers costs more than it saves.
void fetch(const uint8_t* pool, int stride, int count, Found& found) {
  for (int i = 0; i < count; ++i) found.four[i] = fourTexels(pool, found.texel[i], stride);
}

void fetch(const uint8_t* pool, const int* widths, const int* level, int count, Found& found) {
  for (int i = 0; i < count; ++i)
    found.four[i] = fourTexels(pool, found.texel[i], widths[level[i]] + 1);
}

KAGEFUDE_CLONES
void interpolate(const Found& found, int count, float* __restrict value) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) value[i] = grainBetween(found.four[i], found.fx[i], found.fy[i]);
}

KAGEFUDE_CLONES
bool allEqual(const int* __restrict level, int count) {
  int different = 0;
  for (int i = 0; i < count; ++i) different |= level[i] ^ level[0];
  return different == 0;
}

// Neighbours mostly lie in the same level: then its sizes need not be looked up.
void readLevels(const LevelSizes& sizes, const float* u, const float* across, const int* level,
                int count, float* value) {
  alignas(64) float wrappedU[Lookups::most], wrappedAcross[Lookups::most];
  wrapPlaces(u, 1.0f, count, wrappedU);
  wrapPlaces(across, 0.5f, count, wrappedAcross);
  Found found;
  if (count > 0 && allEqual(level, count)) {
    const int l = level[0];
    placeInLevel(sizes.width[l], sizes.height[l], sizes.offset[l], wrappedU, wrappedAcross, count,
                 found);
    fetch(sizes.pool, sizes.width[l] + 1, count, found);
  } else {
    placeInLevels(sizes, wrappedU, wrappedAcross, level, count, found);
    fetch(sizes.pool, sizes.width, level, count, found);
  }
  interpolate(found, count, value);
}

// First probe of every tap; others follow from the list.
KAGEFUDE_CLONES
void placeFirst(const GrainTaps& taps, int first, int count, float* __restrict u,
                float* __restrict across) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float back = 0.5f * static_cast<float>(taps.probes[first + i] - 1);
    u[i] = taps.u[first + i] - back * taps.stepU[first + i];
    across[i] = taps.across[first + i] - back * taps.stepV[first + i];
  }
}

KAGEFUDE_CLONES
void mixLevels(const float* __restrict coarse, const float* __restrict coarser, int count,
               float* __restrict value) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) value[i] += (coarse[i] - value[i]) * coarser[i];
}

KAGEFUDE_CLONES
void nextLevels(const int* __restrict level, int last, int count, int* __restrict next) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) next[i] = level[i] < last ? level[i] + 1 : last;
}

KAGEFUDE_CLONES
bool anyAbove(const float* __restrict values, int count) {
  int above = 0;
  for (int i = 0; i < count; ++i) above |= values[i] > 0.0f ? 1 : 0;
  return above != 0;
}

KAGEFUDE_CLONES
int largestOf(const int* __restrict values, int count) {
  int largest = 0;
  for (int i = 0; i < count; ++i) largest = values[i] > largest ? values[i] : largest;
  return largest;
}

class GrainReader {
 public:
  GrainReader(const StripGrain& grain, GrainTaps& taps) : sizes_(grain), taps_(taps) {}

  int lastLevel() const { return sizes_.last; }

  void read() {
    for (int first = 0; first < taps_.count; first += brushBlock)
      readFirst(first, std::min(first + brushBlock, taps_.count));
    if (largestOf(taps_.probes, taps_.count) < 2) return;
    for (int i = 0; i < taps_.count; ++i)
      for (int probe = 1; probe < taps_.probes[i]; ++probe) addProbe(i, probe);
    flush();
  }

 private:
  void readFirst(int first, int end) {
    alignas(64) float u[brushBlock], across[brushBlock], coarse[brushBlock];
    alignas(64) int next[brushBlock];
    const int count = end - first;
    placeFirst(taps_, first, count, u, across);
    readLevels(sizes_, u, across, taps_.level + first, count, taps_.value + first);
    if (!anyAbove(taps_.coarser + first, count)) return;
    nextLevels(taps_.level + first, sizes_.last, count, next);
    readLevels(sizes_, u, across, next, count, coarse);
    mixLevels(coarse, taps_.coarser + first, count, taps_.value + first);
  }

  void addProbe(int tap, int probe) {
    const float offset =
        static_cast<float>(probe) - 0.5f * static_cast<float>(taps_.probes[tap] - 1);
    const float u = taps_.u[tap] + offset * taps_.stepU[tap];
    const float across = taps_.across[tap] + offset * taps_.stepV[tap];
    const float coarser = taps_.coarser[tap];
    add(tap, u, across, taps_.level[tap], 1.0f - coarser);
    if (coarser > 0.0f) add(tap, u, across, taps_.level[tap] + 1, coarser);
  }

  void add(int tap, float u, float across, int level, float weight) {
    if (list_->count == Lookups::most) flush();
    const int n = list_->count++;
    list_->u[n] = u;
    list_->across[n] = across;
    list_->level[n] = level;
    list_->weight[n] = weight;
    list_->tap[n] = tap;
  }

  void flush() {
    readLevels(sizes_, list_->u, list_->across, list_->level, list_->count, list_->value);
    for (int i = 0; i < list_->count; ++i)
      taps_.value[list_->tap[i]] += list_->value[i] * list_->weight[i];
    list_->count = 0;
  }

  LevelSizes sizes_;
  GrainTaps& taps_;
  std::unique_ptr<Lookups> list_ = std::make_unique_for_overwrite<Lookups>();
};

KAGEFUDE_CLONES
void sumFirst(const GrainTaps& taps, float* __restrict sums) {
  const int pixels = taps.pixels;
#pragma GCC ivdep
  for (int i = 0; i < pixels; ++i)
    sums[i] = taps.value[i] * (taps.weight[i] / static_cast<float>(taps.probes[i]));
}

}  // namespace

void readGrain(const StripGrain& grain, int maxProbes, GrainTaps& taps, float* sums) {
  GrainReader reader(grain, taps);
  const StripGrain::Level& full = grain.levels.front();
  splitTaps(static_cast<float>(full.width), static_cast<float>(full.height),
            static_cast<float>(maxProbes), reader.lastLevel(), taps);
  reader.read();
  sumFirst(taps, sums);
  for (int i = taps.pixels; i < taps.count; ++i)
    sums[taps.pixel[i]] += taps.value[i] * (taps.weight[i] / static_cast<float>(taps.probes[i]));
}

}  // namespace kagefude
