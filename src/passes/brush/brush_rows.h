#pragma once

#include <cstring>

#include "passes/brush/brush_pixel.h"

namespace kagefude {

/// One row of the four result planes.
struct ColourRows {
  float *r, *g, *b, *a;
  float* grain = nullptr;  ///< null: not wanted

  void store(int x, const Rgba& colour) {
    r[x] = colour[0];
    g[x] = colour[1];
    b[x] = colour[2];
    a[x] = colour[3];
  }

  /// The pixels x to x + 3.
  void storeFour(int x, const Rgba* four) {
    const Rgba rg01 = __builtin_shufflevector(four[0], four[1], 0, 4, 1, 5);
    const Rgba rg23 = __builtin_shufflevector(four[2], four[3], 0, 4, 1, 5);
    const Rgba ba01 = __builtin_shufflevector(four[0], four[1], 2, 6, 3, 7);
    const Rgba ba23 = __builtin_shufflevector(four[2], four[3], 2, 6, 3, 7);
    const Rgba planes[4] = {__builtin_shufflevector(rg01, rg23, 0, 1, 4, 5),
                            __builtin_shufflevector(rg01, rg23, 2, 3, 6, 7),
                            __builtin_shufflevector(ba01, ba23, 0, 1, 4, 5),
                            __builtin_shufflevector(ba01, ba23, 2, 3, 6, 7)};
    std::memcpy(r + x, &planes[0], sizeof(Rgba));
    std::memcpy(g + x, &planes[1], sizeof(Rgba));
    std::memcpy(b + x, &planes[2], sizeof(Rgba));
    std::memcpy(a + x, &planes[3], sizeof(Rgba));
  }
};

/// Whether paintHeldRow can do this anchor: held strokes, filtered, all of one
/// size, round one reference point.
bool canPaintHeldRow(const BrushInput& in, const BrushAnchor& anchor);

/// Paints the pixels [first, end) of row y, all of one anchor, to the colours of brushColourAt
/// within a few roundings (2e-6 of the brightest texel) and several times faster: positions,
/// footprints and probes are worked out for many pixels at a time, so that they run in vector
/// registers; only the strip's lookups go pixel by pixel.
void paintHeldRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  ColourRows& out);

}  // namespace kagefude
