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
/// nearest line of either set, 0 on the line to 1 between two; `slanting` is left out with one set.
/// Both uniform and independent give a uniform share.
float hatchShare(float straight, float slanting, int sets);

}  // namespace kagefude
