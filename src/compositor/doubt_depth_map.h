#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"

namespace kagefude {

/// Holds each light's depth map against its masks, where both are read: a map of another light or
/// another frame, or one whose matrices are wrong, hides little of what the masks hide, or much of
/// what they show; a wrongly rendered one holds nothing, or no depth in more than a hundredth of
/// its texels. Such a map is taken out of the planes, so that masks alone make the shadow (a pair
/// is searched by itself), unless there are none or the look asks by name for a method that is made
/// of it. A sentence for each. Masks of which more than a hundredth is NaN or Inf speak against no
/// map, nor does what lies beyond their window. Cost: about a millisecond a light.
std::vector<std::string> setDoubtedMapsAside(const FramePlan& plan, FramePlanes& planes);

}  // namespace kagefude
