#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/styled_surfaces.h"
#include "passes/brush/brush_map.h"

namespace kagefude {

// What a frame's strokes go through until they are a picture (method sections 7 and 8).

/// Multiplies strokes by the surface's colour where their style says so, lets things meet by their
/// coverage, and draws the outlines, whose coverage it gives; empty where no style draws any and
/// `always` is false.
Floats finishStrokes(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                     bool always, BrushResult& brush);

/// The beauty behind the strokes, as output.background asks, and drawn lines over all.
void putBehindAndOver(const Look& look, const FramePlanes& planes, BrushResult& brush);

/// What is doubted about a frame before anything is made of it: of its files, its pixels and its
/// casters.
std::vector<std::string> inputWarnings(const FramePlan& plan, const FramePlanes& planes);

}  // namespace kagefude
