#pragma once

#include "compositor/frame_plan.h"
#include "look/look.h"

namespace kagefude {

// A large frame looked at through every `step`-th of its pixels. Samples, never means: a mean of
// positions lies on no surface, a mean of ids is another object, a mean of hard masks is no mask.
// So a proxy is a smaller frame that the same passes run on, with the look's lengths in pixels
// divided by `step`. It is a preview: thin things may fall between its samples; what is written,
// and what the viewer sharpens to, is made of all pixels.

/// How many pixels make one of a picture whose longer side is at most `size`.
int proxyStep(int width, int height, int size);

/// Pixel (x, y) is pixel (x step + step/2, y step + step/2) of `planes`; what has no pixels of the
/// frame (depth maps, casters) is shared or copied whole. The camera's rays go through the same
/// pixels' centres. step: 2 or more. A frame smaller than a step keeps one pixel.
FramePlanes sampleFrame(const FramePlanes& planes, int step);

/// The plan with the windows of the sampled frame.
FramePlan samplePlan(FramePlan plan, int step);

/// The look as its author wrote it, for sampled planes. output.scale becomes 1: the proxy is not
/// made smaller a second time.
Look sampleLook(Look asked, int step);

}  // namespace kagefude
