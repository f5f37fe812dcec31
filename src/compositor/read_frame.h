#pragma once

#include "compositor/frame_plan.h"

namespace kagefude {

/// Reads the planned pixels, each chunk of the file decoded once. NaN and Inf make a pixel
/// background and are counted; so does a missing normal. Throws InputError.
FramePlanes readFramePlanes(const FramePlan& plan);

}  // namespace kagefude
