#include "compositor/light_visibility.h"

#include <fmt/format.h>

#include "compositor/caster_visibility.h"
#include "passes/depth_map/pcf.h"
#include "passes/depth_map/pcss.h"
#include "passes/light_shape/horizon.h"
#include "passes/light_shape/light_shape.h"
#include "passes/search/classes.h"
#include "passes/search/pair_search.h"
#include "passes/tone/smooth.h"

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

/// What a search must not leave, as the look asks.
View<const uint32_t> boundBy(SearchBound bound, const FramePlanes& frame,
                             View<const uint32_t> surfaces) {
  return bound == SearchBound::surface ? surfaces : frame.objectId.view();
}

LightVisibility fromShape(const FrameLight& light, const LightPlanes& planes,
                          const FramePlanes& frame, View<const uint32_t> surfaces) {
  const LightShapeParams& params = light.passes.lightShape;
  LightShapeResult shape = lightShapeVisibility(
      viewsOf(planes.masks), light.places, boundBy(params.bound, frame, surfaces), frame.position,
      frame.normal, light.geometry, params);
  return {std::move(shape.visibility), std::move(shape.confidence)};
}

Floats fromDepth(const FrameLight& light, const LightPlanes& planes, const FramePlanes& frame,
                 View<const uint32_t> surfaces) {
  const ShadowMap map{planes.depthMap, light.depthMap->lightFromWorld,
                      light.depthMap->clipFromLight};
  if (light.method == ShadowMethod::pcf)
    return pcfVisibility(frame.position, frame.normal, surfaces, map, light.passes.pcf);
  return pcssVisibility(frame.position, frame.normal, surfaces, map, light.light.radius,
                        light.passes.pcss);
}

Floats fromPair(const FrameLight& light, const LightPlanes& planes, const FramePlanes& frame,
                View<const uint32_t> surfaces) {
  const PairParams& params = light.passes.pair;
  const View<const uint32_t> labels = boundBy(params.bound, frame, surfaces);
  const Bytes &farMask = planes.masks.at(0), &nearMask = planes.masks.at(1);
  Floats raw = pairVisibility(farMask, nearMask, labels, params);
  const PairLight shape{light.light.position, light.towardsFar, light.light.radius};
  if (params.horizon && light.towardsFar.length2() > 0 && !frame.position.empty() &&
      !frame.normal.empty())
    settleAtHorizon(farMask, nearMask, labels, frame.position, frame.normal, shape, raw);
  return raw;
}

/// The light's disc from masks that are cut from the casters instead of rendered.
LightVisibility fromPlaces(const FrameLight& light, const FramePlanes& frame,
                           View<const uint32_t> surfaces) {
  const LightShapeParams& params = light.passes.lightShape;
  const CastMasks cast = castMasks(light, frame);
  LightShapeResult shape =
      lightShapeVisibility(viewsOf(cast.masks), cast.places, boundBy(params.bound, frame, surfaces),
                           frame.position, frame.normal, cast.geometry, params);
  return {std::move(shape.visibility), std::move(shape.confidence)};
}

LightVisibility measured(const FrameLight& light, const FramePlan& plan, const LightPlanes& planes,
                         const FramePlanes& frame, View<const uint32_t> surfaces) {
  const auto sure = [&] { return Floats(frame.width, frame.height, 1.0f); };
  switch (light.method) {
    case ShadowMethod::pair:
      return {fromPair(light, planes, frame, surfaces), sure()};
    case ShadowMethod::line:
    case ShadowMethod::disc:
      return fromShape(light, planes, frame, surfaces);
    case ShadowMethod::pcf:
    case ShadowMethod::pcss:
      return {fromDepth(light, planes, frame, surfaces), sure()};
    case ShadowMethod::places:
      return fromPlaces(light, frame, surfaces);
    case ShadowMethod::coverage:
    case ShadowMethod::volume:
    case ShadowMethod::planar:
    case ShadowMethod::blob:
      return {casterVisibility(light, plan, frame), sure()};
    default:
      return {sure(), sure()};
  }
}

bool isSmoothed(const FrameLight& light) {
  switch (light.method) {
    case ShadowMethod::none:
      return false;
    case ShadowMethod::pair:
    case ShadowMethod::pcf:
    case ShadowMethod::pcss:
      return true;
    default:
      return light.passes.smooth.allMethods;
  }
}

}  // namespace

LightVisibility lightVisibility(const FrameLight& light, const FramePlan& plan,
                                const LightPlanes& planes, const FramePlanes& frame,
                                View<const uint32_t> surfaces, StageSink* sink) {
  if (sink) showMasks(light, planes, surfaces, *sink);
  LightVisibility result = measured(light, plan, planes, frame, surfaces);
  if (isSmoothed(light))
    result.visibility = smoothWithinSurfaces(result.visibility, surfaces, light.passes.smooth);
  if (sink) sink->number(fmt::format("visibility.{}", light.name), result.visibility);
  return result;
}

}  // namespace kagefude
