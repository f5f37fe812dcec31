#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"

namespace kagefude {

/// Reads a light's depth map where its method wants one. Where it would only help and is gone, the
/// planes have none and that is said; also where its size or projection is not what the JSON says
/// (the file and the matrix count). Texels that are no depth (NaN, -Inf) hold nothing, and are
/// counted; +Inf is nothing hit. Throws InputError when it cannot be read.
void readDepthMapOf(const FrameLight& light, LightPlanes& planes,
                    std::vector<std::string>& warnings);

}  // namespace kagefude
