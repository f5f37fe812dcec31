#pragma once

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"

namespace kagefude {

/// Holds the mean normals against what they can be, and says what is not (planes.meanWarnings).
/// A mean that is not finite, longer than 1.25 (filters with negative lobes overshoot by a fifth),
/// or 0 where painted things cover all of the pixel is not known and becomes NaN, as it is outside
/// its part. The pass is set aside where that are most pixels that show something, or where on most
/// pixels that one flat thing covers wholly the mean is not that thing's normal (negated, another
/// space, another frame): in healthy frames it is to 0.1. Wants ids and ranks of painted things
/// alone. Cost: reads the means and the coverage; about a millisecond for the flat pixels.
void checkMeanNormals(const FramePlan& plan, FramePlanes& planes);

}  // namespace kagefude
