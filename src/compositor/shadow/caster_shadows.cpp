#include "compositor/shadow/caster_light.h"
#include "passes/casters/planar_projection.h"
#include "passes/casters/shadow_volume.h"

namespace kagefude {

LightVisibility coverageShadow(const ShadowWork& work) {
  const CoverageParams& params = work.light.passes.coverage;
  Floats visibility = shadowCoverage(seenSurface(work.frame), work.frame.casting->set,
                                     placeOf(work.light.light), params);
  coverageToVisibility(visibility, params);
  return {std::move(visibility), {}};
}

LightVisibility volumeShadow(const ShadowWork& work) {
  const CastingScene& scene = *work.frame.casting;
  return visibilityFrom(shadowVolume(seenSurface(work.frame), scene.meshes, scene.set,
                                     placeOf(work.light.light), work.light.passes.volume));
}

LightVisibility planarShadow(const ShadowWork& work) {
  const SeenSurface surface = seenSurface(work.frame);
  const CastingScene& scene = *work.frame.casting;
  const uint32_t receiver = receiverId(work);
  const ReceiverPlane plane = planeOfReceiver(surface, receiver, work.light.receiver);
  return visibilityFrom(planarShadow(surface, receiver, plane, scene.meshes, scene.set,
                                     placeOf(work.light.light), work.light.passes.planar));
}

}  // namespace kagefude
