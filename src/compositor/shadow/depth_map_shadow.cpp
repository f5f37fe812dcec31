#include "compositor/light_visibility.h"
#include "passes/depth_map/pcf.h"
#include "passes/depth_map/pcss.h"

namespace kagefude {
namespace {

ShadowMap mapOf(const ShadowWork& work) {
  const DepthMapSource& source = *work.light.depthMap;
  return {work.planes.depthMap, source.lightFromWorld, source.clipFromLight};
}

}  // namespace

LightVisibility pcfShadow(const ShadowWork& work) {
  return {pcfVisibility(work.frame.position, work.frame.normal, work.surfaces, mapOf(work),
                        work.light.passes.pcf),
          {}};
}

LightVisibility pcssShadow(const ShadowWork& work) {
  return {pcssVisibility(work.frame.position, work.frame.normal, work.surfaces, mapOf(work),
                         work.light.light.radius, work.light.passes.pcss),
          {}};
}

}  // namespace kagefude
