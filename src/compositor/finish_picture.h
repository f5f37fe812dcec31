#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/styled_surfaces.h"
#include "passes/brush/brush_map.h"

namespace kagefude {

// What a frame's strokes go through until they are a picture (method sections 7 and 8).

/// Multiplies strokes by the surface's colour where their style says so, blends them where surfaces
/// meet inside things and where things meet, puts the beauty behind as output.background asks,
/// draws the outlines, and the frame's own drawn lines over all. `joins` are of its surfaces. Gives
/// the outlines' coverage; empty where no style draws any and `outlines` is false.
Floats finishPicture(const Look& look, const FramePlan& plan, const FramePlanes& planes,
                     const StyledSurfaces& styled, View<const uint8_t> joins, bool outlines,
                     BrushResult& brush);

/// What is doubted about a frame before anything is made of it: of its files, its pixels and its
/// casters.
std::vector<std::string> inputWarnings(const FramePlan& plan, const FramePlanes& planes);

}  // namespace kagefude
