#pragma once

#include "compositor/frame_plan.h"
#include "compositor/styled_surfaces.h"
#include "passes/brush/brush_map.h"
#include "passes/edges/behind_paint.h"

namespace kagefude {

/// Lets things meet by their Cryptomatte coverage instead of pixel by pixel, where the frame has
/// it; else leaves the strokes as they are.
void blendEdges(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                BrushResult& brush);

/// Whether the frame has what blendByNormals needs.
bool knowsMeanNormals(const FramePlanes& planes);

/// Blends the strokes at all edges at once, inside objects and between them, by the render's mean
/// normals: in place of blendInside and blendEdges.
void blendByNormals(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                    View<const uint8_t> joins, BrushResult& brush);

/// Blends the strokes where edges run inside an object, and between objects where the frame has no
/// coverage. `joins` are those of its surfaces.
void blendInside(const FramePlanes& planes, const StyledSurfaces& styled, View<const uint8_t> joins,
                 BrushResult& brush);

/// Puts the beauty behind the strokes, each thing once: where coverage is known, not the things
/// that are painted, but what lies beside them.
void putBeautyBehind(const FramePlanes& planes, BrushResult& brush);

/// Ends each style's paint as its [edges] say (paintEdges). `own` is the paint before things met;
/// its grain must be there. `ground` may be null.
void paintStyleEdges(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                     const BrushResult& own, const PaintGround* ground, BrushResult& brush);

/// Draws the styles' contour lines over the strokes, each in the colour of the style of its nearest
/// surface. Returns the lines' coverage (layer `outline`); empty when no style draws any and
/// `always` is false.
Floats drawStyleOutlines(const FramePlan& plan, const FramePlanes& planes,
                         const StyledSurfaces& styled, bool always, BrushResult& brush);

}  // namespace kagefude
