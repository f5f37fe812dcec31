#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"

namespace kagefude {

/// Holds each light's depth map against its masks, where both are read: a map of another light or
/// another frame, or one whose matrices are wrong, hides nothing of what the masks hide. A sentence
/// for each light of which that is so. The methods believe the masks there, pixel by pixel; the
/// shadow is then no better than the masks'. Cost: about a millisecond a light.
std::vector<std::string> doubtDepthMaps(const FramePlan& plan, const FramePlanes& planes);

}  // namespace kagefude
