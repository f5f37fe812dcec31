#pragma once

#include <string>

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"

namespace kagefude {

/// Holds rebuilt positions against the bounds that the JSON gives the objects which they show:
/// depths in other units than the world's scale the scene about the camera, which no normal shows.
/// Where less than half of some 4,000 places lie in their object's bounds (2 % of the diagonal
/// around them count too), that is said, and by what factor the depth would fit where that is one
/// between usual units. "" otherwise, for positions that were not rebuilt, for fewer than 64
/// places, and for objects that are shown more than once. Cost: about a millisecond.
std::string doubtBounds(const FramePlan& plan, const FramePlanes& planes);

}  // namespace kagefude
