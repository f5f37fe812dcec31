#include "compositor/light_visibility.h"

#include <fmt/format.h>

#include "passes/search/classes.h"
#include "passes/tone/smooth.h"

namespace kagefude {
namespace {

void showMasks(const ShadowWork& work, StageSink& sink) {
  const std::vector<Bytes>& masks = work.planes.masks;
  for (size_t i = 0; i < masks.size(); ++i)
    sink.mask(fmt::format("mask {} of {}", i + 1, work.light.name), masks[i]);
  if (!masks.empty())
    sink.classes(fmt::format("classes of {}", work.light.name),
                 classifyShadow(viewsOf(masks), work.surfaces).view());
}

}  // namespace

const ShadowMethodEntry& actingMethod(const FrameLight& light, const LightPlanes& planes) {
  const bool alone = light.method == ShadowMethod::pairDepth && planes.depthMap.empty();
  return entryOf(alone ? ShadowMethod::pair : light.method);
}

bool isSmoothed(const FrameLight& light, const LightPlanes& planes) {
  switch (actingMethod(light, planes).smoothing) {
    case Smoothing::never:
      return false;
    case Smoothing::whereAsked:
      return light.passes.smooth.allMethods;
    case Smoothing::always:
      return true;
  }
  return false;
}

std::vector<View<const uint8_t>> viewsOf(const std::vector<Bytes>& masks) {
  return {masks.begin(), masks.end()};
}

View<const uint32_t> labelsFor(SearchBound bound, const ShadowWork& work) {
  return bound == SearchBound::surface ? work.surfaces : work.frame.objectId.view();
}

LightVisibility lightVisibility(const FrameLight& light, const FramePlan& plan,
                                const LightPlanes& planes, const FramePlanes& frame,
                                View<const uint32_t> surfaces, StageSink* sink) {
  const ShadowWork work{light, plan, planes, frame, surfaces};
  if (sink) showMasks(work, *sink);
  LightVisibility result = actingMethod(light, planes).function(work);
  if (isSmoothed(light, planes))
    result.visibility = smoothWithinSurfaces(result.visibility, surfaces, light.passes.smooth);
  if (sink) sink->number(fmt::format("visibility.{}", light.name), result.visibility);
  return result;
}

LightVisibility noShadow(const ShadowWork& work) {
  return {Floats(work.frame.width, work.frame.height, 1.0f), {}};
}

}  // namespace kagefude
