#pragma once

#include "passes/strip/strip_gradient.h"

namespace kagefude {

/// **[ours]** A strip of pen lines instead of strokes: the gradient's brightness becomes lines of
/// `ink` on its last colour, thicker the darker the tone, the second set across the
/// first from 0.45 of ink on. One field of numbers h says at which share of ink each texel is
/// covered, {h < c} covering c of the strip, so that lines stay where they are as the tone changes;
/// strokes stray by `wobble` and thin out by `pressure` along `stroke_length`. Ink and paper keep a
/// trace of h (2 %) by which makeStripGrain finds the field again. `hatch` is 1 or 2 here.
/// Cost: two noises a texel.
PaintedStrip hatchStrip(const StripPaintParams& params);

/// The share of ink from which a texel is covered, from how far it lies from the middle of the
/// nearest line along the row and across it, 0 on the line to 1 between two; `across` is left out
/// with one set of lines. Both uniform and independent give a uniform share.
float hatchShare(float along, float across, int sets);

}  // namespace kagefude
