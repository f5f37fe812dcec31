#pragma once

#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/styled_surfaces.h"
#include "passes/brush/brush_map.h"

namespace kagefude {

/// Whether the look's paint takes the colour of the lights anywhere.
bool lightsTint(const Look& look);

/// Colour of the light that each pixel gets, of luminance 1: the lights' colours by their tones,
/// in the order of the plan's lights, and `weights`. White where none shines. Lights that no JSON
/// describes are white.
Vec3Plane lightColour(const FramePlan& plan, const std::vector<View<const float>>& tones,
                      const std::vector<float>& weights);

/// Turns paint to the colours of light and shadow by each style's [tint]. `light` may be null:
/// white.
void tintPaint(const StyledSurfaces& styled, View<const float> tone, const Vec3Plane* light,
               BrushResult& brush);

}  // namespace kagefude
