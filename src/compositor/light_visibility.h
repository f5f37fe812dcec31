#pragma once

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"
#include "compositor/stage_sink.h"

namespace kagefude {

struct LightVisibility {
  Floats visibility;  ///< 1 = the light is fully seen; background is 1
  Floats confidence;  ///< 1 = measured, 0 = extrapolated; empty: the method does not tell, all 1
};

/// What a shadow method works on; lives during the call.
struct ShadowWork {
  const FrameLight& light;
  const FramePlan& plan;
  const LightPlanes& planes;  ///< the light's own
  const FramePlanes& frame;
  View<const uint32_t> surfaces;
};

/// One light's visibility by the method chosen for it, smoothed within surfaces (002 section 4.2.2)
/// as the method's row says (look/shadow_methods.h). `sink` may be null.
LightVisibility lightVisibility(const FrameLight& light, const FramePlan& plan,
                                const LightPlanes& planes, const FramePlanes& frame,
                                View<const uint32_t> surfaces, StageSink* sink);

/// The method that makes a light's shadow: the light's own, but `pair` where a pair's depth map was
/// set aside (setDoubtedMapsAside).
const ShadowMethodEntry& actingMethod(const FrameLight& light, const LightPlanes& planes);

/// Whether lightVisibility smooths what the light's method finds.
bool isSmoothed(const FrameLight& light, const LightPlanes& planes);

/// The labels that a search must not leave, as the look asks.
View<const uint32_t> labelsFor(SearchBound bound, const ShadowWork& work);

/// Masks as the passes take them.
std::vector<View<const uint8_t>> viewsOf(const std::vector<Bytes>& masks);

}  // namespace kagefude
