#pragma once

#include "passes/brush_block.h"

// The arithmetic of object grain for a run of neighbouring pixels, in arrays for vector registers.
namespace kagefude {

/// Patterns of a block's pixels. The first `pixels` taps are the pixels' weightiest ones, one each;
/// those behind belong to pixels where patterns lie over each other, or octaves.
struct GrainTaps {
  static constexpr int most = 12 * brushBlock;
  int pixels = 0, count = 0;
  alignas(64) float u[most], across[most], weight[most];
  alignas(64) float ux[most], uy[most], vx[most], vy[most];
  alignas(64) float stepU[most], stepV[most], coarser[most], value[most];
  alignas(64) int probes[most], level[most];
  int pixel[most];  ///< of the taps behind the first `pixels`

  alignas(64) float faces[3][brushBlock];       ///< how much the surface faces each axis
  alignas(64) float alongFirst[3][brushBlock];  ///< share of the strokes along axis k + 1
  alignas(64) float gain[brushBlock];           ///< makes shares weights
  alignas(64) int patterns[brushBlock];         ///< how many lie over each other
};

/// Lists the taps of a loaded block. `aspect`: width over height of the grain in texels.
void listGrainTaps(const BrushInput& in, const BrushAnchor& anchor, float aspect, int count,
                   const BrushBlock& block, GrainTaps& taps);

/// Reads the grain of every tap, filtered over its footprint, and sums it into grain[pixel].
void readGrain(const StripGrain& grain, int maxProbes, GrainTaps& taps, float* sums);

}  // namespace kagefude
