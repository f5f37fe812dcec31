#include <algorithm>
#include <cmath>
#include <memory>

#include "image/clones.h"
#include "passes/brush/grain_block.h"
#include "passes/brush/grain_lookup.h"

namespace kagefude {
namespace {

/// Sizes of the grain's levels in arrays, and its texels.
struct LevelSizes {
  static constexpr int most = 16;
  int width[most], height[most], offset[most];
  int last = 0;
  const uint32_t* pool = nullptr;

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

/// Level below a lod, and the share of the one above it.
struct LevelMix {
  int level;
  float coarser;
};

inline LevelMix mixAt(float lod, float most) {
  const float between = lod < most ? lod : most;
  const int fine = static_cast<int>(between);
  const float share = levelShare(between - static_cast<float>(fine));
  return {fine + (share >= 1.0f ? 1 : 0), share >= 1.0f ? 0.0f : share};
}

// One texel's probe for every tap, and which taps need more.
KAGEFUDE_CLONES
void measureTaps(float w, float h, GrainTaps& taps) {
  float* __restrict coarser = taps.coarser;
  int* __restrict larger = taps.larger, * __restrict level = taps.level;
  const int count = taps.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const bool one = needsOneTexel(taps.ux[i] * w, taps.vx[i] * h, taps.uy[i] * w, taps.vy[i] * h);
    larger[i] = one ? 0 : 1;
    level[i] = 0;
    coarser[i] = 0.0f;
  }
}

// Levels and probes of a group of taps: places become those of the first probes, weights those of
// each. Roots and divisions that most groups do without.
KAGEFUDE_CLONES
void splitTaps(float w, float h, float maxProbes, int lastLevel, int first, GrainTaps& taps) {
  const float most = static_cast<float>(lastLevel);
#pragma GCC ivdep
  for (int i = first; i < first + grainLanes; ++i) {
    const GrainEllipse e =
        grainEllipse(taps.ux[i] * w, taps.vx[i] * h, taps.uy[i] * w, taps.vy[i] * h);
    float n, lod, du, dv;
    grainProbes(e, w, h, maxProbes, n, lod, du, dv);
    const LevelMix mix = mixAt(lod, most);
    const float back = 0.5f * (n - 1.0f);
    taps.level[i] = mix.level;
    taps.coarser[i] = mix.coarser;
    taps.probes[i] = static_cast<int>(n);
    taps.stepU[i] = du;
    taps.stepV[i] = dv;
    // The footprint is done with: it keeps the middle.
    taps.ux[i] = taps.u[i];
    taps.vx[i] = taps.across[i];
    taps.u[i] -= back * du;
    taps.across[i] -= back * dv;
    taps.weight[i] *= 1.0f / n;
  }
}

/// Loops of their own, or the compiler keeps branches and plain registers.
KAGEFUDE_CLONES
void wrapPlaces(const float* __restrict places, float scale, int count, float* __restrict wrapped) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) wrapped[i] = fractionOf(places[i] * scale);
}

/// Where lookups are written to.
struct Places {
  int* texel;
  float *fx, *fy;
};

KAGEFUDE_CLONES
void placeInLevels(const LevelSizes& sizes, const float* __restrict u,
                   const float* __restrict across, const int* __restrict level, int count,
                   const Places& places) {
  int* __restrict texel = places.texel;
  float* __restrict fx = places.fx, * __restrict fy = places.fy;
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
                  const float* __restrict across, int count, const Places& places) {
  int* __restrict texel = places.texel;
  float* __restrict fx = places.fx, * __restrict fy = places.fy;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const GrainPlace place = grainPlace(u[i], across[i], width, height, offset);
    texel[i] = place.texel;
    fx[i] = place.fx;
    fy[i] = place.fy;
  }
}

KAGEFUDE_CLONES
void interpolate(const uint32_t* __restrict four, const float* __restrict fx,
                 const float* __restrict fy, int count, float* __restrict value) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) value[i] = grainBetween(four[i], fx[i], fy[i]);
}

KAGEFUDE_CLONES
bool allEqual(const int* __restrict level, int count) {
  int different = 0;
  for (int i = 0; i < count; ++i) different |= level[i] ^ level[0];
  return different == 0;
}

// Neighbours mostly lie in the same level: then its sizes need not be looked up.
void placeLookups(const LevelSizes& sizes, const float* u, const float* across, const int* level,
                  int count, const Places& places) {
  alignas(64) float wrappedU[GrainTaps::most], wrappedAcross[GrainTaps::most];
  wrapPlaces(u, 1.0f, count, wrappedU);
  wrapPlaces(across, 0.5f, count, wrappedAcross);
  if (count > 0 && allEqual(level, count)) {
    const int l = level[0];
    placeInLevel(sizes.width[l], sizes.height[l], sizes.offset[l], wrappedU, wrappedAcross, count,
                 places);
  } else {
    placeInLevels(sizes, wrappedU, wrappedAcross, level, count, places);
  }
}

// Texels one by one: gathering in vector registers costs more than it saves.
void readPlaces(const uint32_t* pool, const Places& places, int count, float* value) {
  alignas(64) uint32_t four[GrainTaps::most];
  for (int i = 0; i < count; ++i) four[i] = pool[places.texel[i]];
  interpolate(four, places.fx, places.fy, count, value);
}

/// Where a group of lookups is written to.
struct LookupRows {
  float *u, *across, *weight;
  int* level;
};

// One more probe of a group, or the same in the next level.
KAGEFUDE_CLONES
void fillLookups(const GrainTaps& taps, int first, int probe, int levelsUp, int last,
                 const LookupRows& list) {
  const float steps = static_cast<float>(probe), up = static_cast<float>(levelsUp);
#pragma GCC ivdep
  for (int l = 0; l < grainLanes; ++l) {
    const float coarser = taps.coarser[first + l];
    const float share = up > 0.0f ? coarser : 1.0f - coarser;
    const float weight = taps.weight[first + l] * share;
    const int level = taps.level[first + l] + levelsUp;
    const float offset = steps - 0.5f * static_cast<float>(taps.probes[first + l] - 1);
    list.u[l] = taps.ux[first + l] + offset * taps.stepU[first + l];
    list.across[l] = taps.vx[first + l] + offset * taps.stepV[first + l];
    list.level[l] = level < last ? level : last;
    list.weight[l] = probe < taps.probes[first + l] ? weight : 0.0f;
  }
}

KAGEFUDE_CLONES
void addGroup(const float* __restrict value, const float* __restrict weight,
              float* __restrict sums) {
#pragma GCC ivdep
  for (int l = 0; l < grainLanes; ++l) sums[l] += value[l] * weight[l];
}

KAGEFUDE_CLONES
void addFadingGroup(const float* __restrict value, const float* __restrict weight,
                    const float* __restrict coarser, float* __restrict sums) {
#pragma GCC ivdep
  for (int l = 0; l < grainLanes; ++l) sums[l] += value[l] * (weight[l] * (1.0f - coarser[l]));
}

}  // namespace

/// Lookups of single levels beyond each tap's first, a group at a time.
struct GrainReader::Lookups {
  static constexpr int most = 512;
  int count = 0;
  alignas(64) float u[most], across[most], weight[most], value[most];
  alignas(64) float fx[most], fy[most];
  alignas(64) int level[most], texel[most];
  int pixel[most / grainLanes];
};

GrainReader::GrainReader(const StripGrain& grain, int maxProbes)
    : grain_(grain),
      maxProbes_(static_cast<float>(maxProbes)),
      list_(std::make_unique_for_overwrite<Lookups>()) {
  list_->count = 0;
}

GrainReader::~GrainReader() = default;

void GrainReader::place(GrainTaps& taps) const {
  const LevelSizes sizes(grain_);
  const StripGrain::Level& full = grain_.levels.front();
  const float w = static_cast<float>(full.width), h = static_cast<float>(full.height);
  measureTaps(w, h, taps);
  for (int first = 0; first < taps.count; first += grainLanes)
    if (bitsOf(taps.larger + first) != 0) splitTaps(w, h, maxProbes_, sizes.last, first, taps);
  placeLookups(sizes, taps.u, taps.across, taps.level, taps.count, {taps.texel, taps.fx, taps.fy});
  for (int i = 0; i < taps.count; ++i) __builtin_prefetch(sizes.pool + taps.texel[i]);
}

void GrainReader::read(GrainTaps& taps, float* sums) {
  std::fill_n(sums, brushBlock, 0.0f);
  readPlaces(grain_.pool.row(0), {taps.texel, taps.fx, taps.fy}, taps.count, taps.value);
  for (int first = 0; first < taps.count; first += grainLanes) addFirst(taps, first, sums);
  flush(sums);
}

// Sums a group's first probes and lists what else it reads.
void GrainReader::addFirst(GrainTaps& taps, int first, float* sums) {
  float* const to = sums + taps.pixel[first / grainLanes];
  if (bitsOf(taps.larger + first) == 0)
    return addGroup(taps.value + first, taps.weight + first, to);
  addFadingGroup(taps.value + first, taps.weight + first, taps.coarser + first, to);
  const bool fades = bitsOf(taps.coarser + first) != 0;
  const int* const probes = taps.probes + first;
  const int largest = *std::max_element(probes, probes + grainLanes);
  for (int probe = 0; probe < largest; ++probe) {
    if (probe > 0) add(taps, first, probe, 0, sums);
    if (fades) add(taps, first, probe, 1, sums);
  }
}

void GrainReader::add(const GrainTaps& taps, int first, int probe, int levelsUp, float* sums) {
  if (list_->count == Lookups::most) flush(sums);
  const int n = list_->count;
  list_->pixel[n / grainLanes] = taps.pixel[first / grainLanes];
  fillLookups(taps, first, probe, levelsUp, static_cast<int>(grain_.levels.size()) - 1,
              {list_->u + n, list_->across + n, list_->weight + n, list_->level + n});
  list_->count += grainLanes;
}

void GrainReader::flush(float* sums) {
  Lookups& list = *list_;
  const Places places{list.texel, list.fx, list.fy};
  placeLookups(LevelSizes(grain_), list.u, list.across, list.level, list.count, places);
  readPlaces(grain_.pool.row(0), places, list.count, list.value);
  for (int first = 0; first < list.count; first += grainLanes)
    addGroup(list.value + first, list.weight + first, sums + list.pixel[first / grainLanes]);
  list.count = 0;
}

}  // namespace kagefude
