#pragma once

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"
#include "compositor/stage_sink.h"

namespace kagefude {

struct LightVisibility {
  Floats visibility;  ///< 1 = the light is fully seen; background is 1
  Floats confidence;  ///< 1 = measured, 0 = extrapolated; 1 for methods that do not tell
};

/// One light's visibility by the method chosen for it. What pair, pcf and pcss give is smoothed
/// within surfaces (002 section 4.2.2). Other methods only where smooth.all_methods asks for it:
/// disc, line and places are smooth of themselves, and a window would blur their contacts; the
/// casters' other methods draw clean edges. `sink` may be null.
LightVisibility lightVisibility(const FrameLight& light, const FramePlan& plan,
                                const LightPlanes& planes, const FramePlanes& frame,
                                View<const uint32_t> surfaces, StageSink* sink);

}  // namespace kagefude
