#pragma once

#include "passes/strip/strip.h"

// Bilinear lookups of a strip in long lists: everything about a lookup but the texels themselves is
// worked out in vector registers.
namespace kagefude {

/// Lookups of a block of pixels, in the pixels' order.
struct SampleList {
  static constexpr int most = 1024;
  int count = 0;
  alignas(64) float u[most], v[most], weight[most];
  alignas(64) int level[most];
  alignas(64) int offset[most], right[most], down[most];  ///< of the texels, from the strip's pool
  alignas(64) float fx[most], fy[most];

  void add(float atU, float atV, int ofLevel, float ofWeight) {
    u[count] = atU;
    v[count] = atV;
    level[count] = ofLevel;
    weight[count++] = ofWeight;
  }
};

/// Sizes of a strip's levels in arrays.
struct LevelTable {
  static constexpr int most = 16;
  int width[most], height[most], offset[most];
  int last = 0;

  explicit LevelTable(const Strip& strip);
};

/// Finds every sample's four texels and their shares.
void placeSamples(const LevelTable& levels, SampleList& samples);

/// Asks for the samples' texels before they are needed: their rows lie far apart in memory.
inline void fetchAhead(const Rgba* pool, const SampleList& s) {
  for (int i = 0; i < s.count; ++i) {
    __builtin_prefetch(pool + s.offset[i]);
    __builtin_prefetch(pool + s.offset[i] + s.down[i]);
  }
}

/// Weighted sum of the samples [first, end).
inline Rgba sumSamples(const Rgba* pool, const SampleList& s, int first, int end) {
  Rgba sum{};
  for (int i = first; i < end; ++i) {
    const Rgba* texel = pool + s.offset[i];
    const Rgba* lower = texel + s.down[i];
    const Rgba a = texel[0], b = texel[s.right[i]], c = lower[0], d = lower[s.right[i]];
    const Rgba top = a + (b - a) * s.fx[i];
    const Rgba bottom = c + (d - c) * s.fx[i];
    sum += (top + (bottom - top) * s.fy[i]) * s.weight[i];
  }
  return sum;
}

}  // namespace kagefude
