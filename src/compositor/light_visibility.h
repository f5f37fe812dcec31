#pragma once

#include "compositor/frame_light.h"
#include "compositor/frame_planes.h"
#include "compositor/stage_sink.h"

namespace kagefude {

/// One light's visibility by the method chosen for it, smoothed within surfaces (002 section
/// 4.2.2): 1 = the light is fully seen. Background is 1. `sink` may be null.
Floats lightVisibility(const FrameLight& light, const LightPlanes& planes, const FramePlanes& frame,
                       View<const uint32_t> surfaces, StageSink* sink);

}  // namespace kagefude
