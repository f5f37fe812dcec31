#include "compositor/light_visibility.h"
#include "passes/depth_map/hold_to_map.h"
#include "passes/light_shape/light_shape.h"

namespace kagefude {
namespace {

std::vector<PlacedMask> placedMasks(const ShadowWork& work) {
  const FrameLight& light = work.light;
  std::vector<PlacedMask> placed;
  for (size_t k = 0; k < work.planes.masks.size(); ++k)
    placed.push_back({work.planes.masks[k], light.geometry->u * light.places[k].x +
                                                light.geometry->v * light.places[k].y});
  return placed;
}

}  // namespace

LightVisibility lightShapeShadow(const ShadowWork& work) {
  const FrameLight& light = work.light;
  const FramePlanes& frame = work.frame;
  const LightShapeParams& params = light.passes.lightShape;
  const bool hasMap = !work.planes.depthMap.empty() && params.lightSize > 0;
  LightShapeResult shape = lightShapeVisibility(
      viewsOf(work.planes.masks), light.places, labelsFor(params.bound, work), frame.position,
      frame.normal, light.geometry, params, {light.tellsConfidence, hasMap});
  if (!shape.unsure.empty()) {
    const ShadowMap map{work.planes.depthMap, light.depthMap->lightFromWorld,
                        light.depthMap->clipFromLight};
    holdToMap(placedMasks(work), frame.position, frame.normal, work.surfaces, map,
              light.light.radius * params.lightSize, shape);
  }
  return {std::move(shape.visibility), std::move(shape.confidence)};
}

}  // namespace kagefude
