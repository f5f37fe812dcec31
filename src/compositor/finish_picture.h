#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/strip_set.h"
#include "compositor/styled_surfaces.h"
#include "passes/brush/brush_map.h"

namespace kagefude {

// What a frame's strokes go through until they are a picture (method sections 7 and 8).

/// A frame whose strokes are laid.
struct FinishInput {
  const Look& look;
  const StripSet& strips;
  const FramePlan& plan;
  const FramePlanes& planes;
  const StyledSurfaces& styled;
  View<const float> tone;                  ///< that the strokes were picked by
  View<const uint8_t> joins;               ///< of its surfaces
  const Vec3Plane* lightColour = nullptr;  ///< see the function; null: lights do not tint
  const BrushResult* ownLights = nullptr;  ///< what paintOwnLights gave; null: nothing
  bool outlines = false;  ///< whether the lines' coverage is wanted where no style draws any
};

/// Multiplies strokes by the surface's colour where their style says so, tints them, adds what
/// lights with strips of their own add, blends them where surfaces meet inside things and where
/// things meet, lays them on the ground that output.background asks for, ends them as [edges] says,
/// draws the outlines, and the frame's own drawn lines over all. Gives the outlines' coverage;
/// empty where no style draws any and `outlines` is false. The brush's grain is there where
/// keepsGrain says so.
Floats finishPicture(const FinishInput& in, BrushResult& brush);

/// What is doubted about a frame before anything is made of it: of its files, its pixels and its
/// casters.
std::vector<std::string> inputWarnings(const FramePlan& plan, const FramePlanes& planes);

/// What is doubted about passes that only edges use, where the frame's styles let them.
std::vector<std::string> edgeWarnings(const FramePlanes& planes, const StyledSurfaces& styled);

}  // namespace kagefude
