#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"

namespace kagefude {

/// **[ours]** Things that the frame's Cryptomatte covers pixels with (16 in all, or more) while no
/// pixel's centre shows them: more than half see-through, or thinner than pixels. Nothing is
/// painted of them, as there is no surface to paint, and what lies behind takes their share. Only
/// things that the frame names; rising by name. Empty without coverage. Before unpainted things are
/// cleared. Cost: one look at each pixel's first rank, more at edges.
std::vector<std::string> unseenThings(const FramePlan& plan, const FramePlanes& planes);

}  // namespace kagefude
