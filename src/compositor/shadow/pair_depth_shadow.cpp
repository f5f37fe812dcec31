#include "compositor/light_visibility.h"
#include "passes/depth_map/pair_depth.h"

namespace kagefude {

LightVisibility pairDepthShadow(const ShadowWork& work) {
  const FrameLight& light = work.light;
  const FramePlanes& frame = work.frame;
  const PairDepthParams& params = light.passes.pairDepth;
  const ShadowMap map{work.planes.depthMap, light.depthMap->lightFromWorld,
                      light.depthMap->clipFromLight};
  const MaskPair masks{work.planes.masks.at(0),
                       work.planes.masks.at(1),
                       {light.light.position, light.towardsFar, light.light.radius}};
  return {pairDepthVisibility(masks, frame.position, frame.normal, labelsFor(params.bound, work),
                              work.surfaces, map, params),
          {}};
}

}  // namespace kagefude
