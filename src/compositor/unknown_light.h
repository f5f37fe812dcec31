#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"

namespace kagefude {

/// What of the frame all masks of a light (or its traced visibility) cover, in pixels of the
/// frame's planes; all of it where they lie in no part of its own window. May be empty.
Window maskedWindow(const FramePlan& plan, const FrameLight& light);

/// Says for each light where nothing is known of what it lights, and that this is taken as lit, for
/// no shadow shall be made up: where masks or traced visibility are NaN or Inf, and surfaces that
/// lie beyond the window of their part. Masks come so from their reader; traced visibility is made
/// so here. A part that is cut to what can be seen leaves no surface out, and is not said. Cost:
/// nothing for masks of the whole frame, a pass for traced visibility.
std::vector<std::string> takeUnknownAsLit(const FramePlan& plan, FramePlanes& planes);

}  // namespace kagefude
