#pragma once

#include "passes/brush/brush_rows.h"

namespace kagefude {

/// Whether paintSeedRow can do this anchor: the seed's mapping round one reference point,
/// not at rest.
bool canPaintSeedRow(const BrushInput& in, const BrushAnchor& anchor);

/// Paints the pixels [first, end) of row y, all of one anchor, to the colours of brushColourAt, bit
/// for bit: angles, rings and places in vector registers, then two bilinear lookups a pixel, or one
/// where the rings do not blend.
void paintSeedRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  ColourRows& out);

}  // namespace kagefude
