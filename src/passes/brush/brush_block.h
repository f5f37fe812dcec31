#pragma once

#include "passes/brush/brush_pixel.h"

// The brush pass's arithmetic for a run of neighbouring pixels of one row and one anchor, in
// arrays, so that it runs in vector registers.
namespace kagefude {

inline constexpr int brushBlock = 128;

/// What is worked out for each pixel of a run; index 0 is the first.
struct BrushBlock {
  /// Pixels with one neighbour on either side. `absent` is 0 for finite pixels of the anchor, else
  /// noChange, and the rest 0.
  struct Line {
    alignas(64) float x[brushBlock + 2], y[brushBlock + 2], z[brushBlock + 2];
    alignas(64) float tone[brushBlock + 2], absent[brushBlock + 2];
  };
  struct Change {
    alignas(64) float x[brushBlock], y[brushBlock], z[brushBlock], tone[brushBlock];
  };
  Line above, here, below;
  Change across, down;
  /// Unit, zero where it is not known; at rest along the object's axes, see BrushPixel.
  alignas(64) float normalX[brushBlock], normalY[brushBlock], normalZ[brushBlock];
  /// Along each of the object's axes: the place, its change across and down, the axis's weight.
  alignas(64) float place[3][brushBlock], placeAcross[3][brushBlock], placeDown[3][brushBlock];
  alignas(64) float weight[3][brushBlock];
  /// Weight of the row's mean; with the axes' weights it makes 1.
  alignas(64) float meanGain[brushBlock];
};

/// Fills what depends on the pixels alone: all but the weights and gains. For the pixels
/// [first, end) of row y, at most brushBlock of them.
void loadBlock(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
               BrushBlock& block);

/// The same, with weights and gains of strokes that run along the tone.
void prepareBlock(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  BrushBlock& block);

}  // namespace kagefude
