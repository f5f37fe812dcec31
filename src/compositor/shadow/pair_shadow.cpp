#include "compositor/light_visibility.h"
#include "passes/light_shape/horizon.h"
#include "passes/search/pair_search.h"

namespace kagefude {

LightVisibility pairShadow(const ShadowWork& work) {
  const FrameLight& light = work.light;
  const FramePlanes& frame = work.frame;
  const PairParams& params = light.passes.pair;
  const View<const uint32_t> labels = labelsFor(params.bound, work);
  const Bytes &farMask = work.planes.masks.at(0), &nearMask = work.planes.masks.at(1);
  Floats raw = pairVisibility(farMask, nearMask, labels, params);
  const PairLight shape{light.light.position, light.towardsFar, light.light.radius};
  if (params.horizon && light.towardsFar.length2() > 0 && !frame.position.empty() &&
      !frame.normal.empty())
    settleAtHorizon(farMask, nearMask, labels, frame.position, frame.normal, shape, raw);
  return {std::move(raw), {}};
}

}  // namespace kagefude
