#include "compositor/light_visibility.h"

#include <fmt/format.h>

#include "passes/classes.h"
#include "passes/pair_search.h"
#include "passes/pcf.h"
#include "passes/smooth.h"

namespace kagefude {
namespace {

std::vector<View<const uint8_t>> viewsOf(const std::vector<Bytes>& masks) {
  return {masks.begin(), masks.end()};
}

void showMasks(const FrameLight& light, const LightPlanes& planes, View<const uint32_t> surfaces,
               StageSink& sink) {
  for (size_t i = 0; i < planes.masks.size(); ++i)
    sink.mask(fmt::format("mask {} of {}", i + 1, light.name), planes.masks[i]);
  if (!planes.masks.empty())
    sink.classes(fmt::format("classes of {}", light.name),
                 classifyShadow(viewsOf(planes.masks), surfaces).view());
}

Floats unsmoothed(const FrameLight& light, const LightPlanes& planes, const FramePlanes& frame,
                  View<const uint32_t> surfaces) {
  switch (light.method) {
    case ShadowMethod::pair:
      return pairVisibility(
          planes.masks.at(0), planes.masks.at(1),
          light.passes.pair.bound == SearchBound::surface ? surfaces : frame.objectId,
          light.passes.pair);
    case ShadowMethod::pcf: {
      const ShadowMap map{planes.depthMap, light.depthMap->lightFromWorld,
                          light.depthMap->clipFromLight};
      return pcfVisibility(frame.position, frame.normal, surfaces, map, light.passes.pcf);
    }
    default:
      return Floats(frame.width, frame.height, 1.0f);
  }
}

}  // namespace

Floats lightVisibility(const FrameLight& light, const LightPlanes& planes, const FramePlanes& frame,
                       View<const uint32_t> surfaces, StageSink* sink) {
  if (sink) showMasks(light, planes, surfaces, *sink);
  Floats visibility = unsmoothed(light, planes, frame, surfaces);
  if (light.method != ShadowMethod::none)
    visibility = smoothWithinSurfaces(visibility, surfaces, light.passes.smooth);
  if (sink) sink->number(fmt::format("visibility.{}", light.name), visibility);
  return visibility;
}

}  // namespace kagefude
