#pragma once

#include <cstring>
#include <memory>

#include "passes/brush/brush_block.h"

// The arithmetic of object grain for a run of neighbouring pixels, in arrays for vector registers.
namespace kagefude {

/// Patterns are listed for so many neighbouring pixels at a time: one vector register's worth.
inline constexpr int grainLanes = 16;

/// Patterns of a block's pixels, `grainLanes` neighbours at a time; a pixel of them that the
/// pattern does not touch has weight 0.
struct GrainTaps {
  static constexpr int most = 12 * brushBlock;
  int count = 0;  ///< a multiple of grainLanes
  alignas(64) float u[most], across[most], weight[most];
  alignas(64) float ux[most], uy[most], vx[most], vy[most];
  alignas(64) float stepU[most], stepV[most], coarser[most], value[most];
  alignas(64) int probes[most], level[most], larger[most];
  /// Where the first probes lie in the grain's pool, and their shares of the next texels.
  alignas(64) int texel[most];
  alignas(64) float fx[most], fy[most];
  int pixel[most / grainLanes];  ///< the first pixel of each group

  alignas(64) float faces[3][brushBlock];  ///< how much the surface faces each axis
  /// Of the strokes in the plane that faces axis k, along axis k + 1 and along axis k + 2.
  alignas(64) float share[3][2][brushBlock];
  alignas(64) int patterns[brushBlock];  ///< bit 2 k + side is set where that share is above 0
};

/// All bits of a group's numbers: 0 where all are 0, as floats that are not below 0 too.
template <class T>
inline int bitsOf(const T* group) {
  static_assert(sizeof(T) == 4);
  uint64_t pairs[grainLanes / 2], bits = 0;
  std::memcpy(pairs, group, sizeof pairs);
  for (const uint64_t pair : pairs) bits |= pair;
  return static_cast<int>(bits | bits >> 32);
}

/// Lists the taps of a loaded block (whose last group is made whole). `aspect`: width over height
/// of the grain in texels.
void listGrainTaps(const BrushInput& in, const BrushAnchor& anchor, float aspect, int count,
                   BrushBlock& block, GrainTaps& taps);

/// Reads a grain for one block of taps after the other, in two steps, so that the caller has time
/// to fill with other work while the texels come.
class GrainReader {
 public:
  GrainReader(const StripGrain& grain, int maxProbes);
  ~GrainReader();

  /// Finds levels, probes and places of every tap, and asks for the first probes' texels.
  void place(GrainTaps& taps) const;

  /// Reads the grain of every placed tap, filtered over its footprint, and sums it into
  /// sums[pixel], brushBlock of them.
  void read(GrainTaps& taps, float* sums);

 private:
  struct Lookups;

  void addFirst(GrainTaps& taps, int first, float* sums);
  void add(const GrainTaps& taps, int first, int probe, int levelsUp, float* sums);
  void flush(float* sums);

  const StripGrain& grain_;
  float maxProbes_;
  std::unique_ptr<Lookups> list_;  ///< probes and levels beyond each tap's first
};

}  // namespace kagefude
