#pragma once

#include "passes/brush/brush_rows.h"

namespace kagefude {

/// Whether paintPolarRow can do this anchor: polar strokes, filtered, round one reference point.
bool canPaintPolarRow(const BrushInput& in, const BrushAnchor& anchor);

/// Paints the pixels [first, end) of row y, all of one anchor, as paintHeldRow does: to the colours
/// of brushColourAt within a few roundings.
void paintPolarRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                   ColourRows& out);

}  // namespace kagefude
