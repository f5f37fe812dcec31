#pragma once

#include "passes/brush_pixel.h"

namespace kagefude {

/// One row of the four result planes.
struct ColourRows {
  float *r, *g, *b, *a;

  void store(int x, const Rgba& colour) {
    r[x] = colour[0];
    g[x] = colour[1];
    b[x] = colour[2];
    a[x] = colour[3];
  }
};

/// Whether paintHeldRow can do this anchor: held strokes, filtered, round one reference point.
bool canPaintHeldRow(const BrushInput& in, const BrushAnchor& anchor);

/// Paints the pixels [first, end) of row y, all of one anchor, to the colours of brushColourAt
/// within a few roundings (2e-6 of the brightest texel) and several times faster: positions,
/// footprints and probes are worked out for many pixels at a time, so that they run in vector
/// registers; only the strip's lookups go pixel by pixel.
void paintHeldRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  ColourRows& out);

}  // namespace kagefude
