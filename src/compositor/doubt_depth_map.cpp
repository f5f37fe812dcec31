#include "compositor/doubt_depth_map.h"

#include <fmt/format.h>

#include "compositor/light_visibility.h"
#include "passes/depth_map/map_agreement.h"

namespace kagefude {

std::vector<std::string> setDoubtedMapsAside(const FramePlan& plan, FramePlanes& planes) {
  std::vector<std::string> doubts;
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    const FrameLight& light = plan.lights[i];
    LightPlanes& own = planes.lights[i];
    if (own.depthMap.empty() || own.masks.empty()) continue;
    const ShadowMap map{own.depthMap, light.depthMap->lightFromWorld,
                        light.depthMap->clipFromLight};
    const MapAgreement found = agreementOf(viewsOf(own.masks), light.light, planes.position,
                                           planes.normal, planes.objectId, map);
    if (!found.contradicts()) continue;
    const ShadowMethodEntry& method = entryOf(light.method);
    const bool asked = method.needs.depthMap && !light.automatic;
    doubts.push_back(fmt::format(
        "the depth map of light {} ({}) does not fit its masks: it hides {} of {} places that they "
        "hide and shows {} of {} that they show, as the map of another light or frame would; {}",
        light.name, light.depthMap->file.string(), found.hiddenInMap, found.hidden, found.litInMap,
        found.lit,
        asked
            ? fmt::format("it is used all the same, for shadow.method is \"{}\"; export both "
                          "together, or take \"auto\", which sets such a map aside",
                          method.name)
            : "it is set aside, and the masks alone make the shadow; export both together, or say "
              "light_shape.depth_map = false"));
    if (!asked) own.depthMap = Floats();
  }
  return doubts;
}

}  // namespace kagefude
