#pragma once

#include "passes/brush/brush_rows.h"

namespace kagefude {

/// Whether paintObjectRow can do this anchor: held strokes that stay on the object, filtered, all
/// of one size.
bool canPaintObjectRow(const BrushInput& in, const BrushAnchor& anchor);

/// Paints the pixels [first, end) of row y, all of one anchor, to the colours of brushColourAt
/// within a few roundings (1e-4 of the brightest texel, for the grain's steepest colours), in
/// vector registers but for the last step, the colours.
void paintObjectRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                    ColourRows& out);

}  // namespace kagefude
