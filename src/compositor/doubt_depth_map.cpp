#include "compositor/doubt_depth_map.h"

#include <fmt/format.h>

#include <numeric>

#include "compositor/light_visibility.h"
#include "compositor/unknown_light.h"
#include "passes/depth_map/map_agreement.h"

namespace kagefude {
namespace {

/// A map or masks of which more is not known are not what anything is held against.
constexpr double mostUnknown = 0.01;

bool isMuch(size_t unknown, size_t all) {
  return static_cast<double>(unknown) > mostUnknown * static_cast<double>(all);
}

/// A light with its map, and how sentences call that.
struct HeldMap {
  const FrameLight& light;
  const LightPlanes& own;
  std::string name;
};

size_t texelsOf(const HeldMap& held) { return held.own.depthMap.view().pixels(); }

bool masksAreKnown(const LightPlanes& own, size_t pixels) {
  const size_t unknown = std::accumulate(own.unknown.begin(), own.unknown.end(), size_t{0});
  return !own.masks.empty() && !isMuch(unknown, pixels * own.masks.size());
}

MapAgreement agreementWith(const HeldMap& held, const FramePlan& plan, const FramePlanes& planes) {
  const ShadowMap map{held.own.depthMap, held.light.depthMap->lightFromWorld,
                      held.light.depthMap->clipFromLight};
  const auto agreement = [&](View<const uint32_t> labels) {
    return agreementOf(viewsOf(held.own.masks), held.light.light, planes.position, planes.normal,
                       labels, map);
  };
  const Window known = maskedWindow(plan, held.light);
  if (known == Window{0, 0, planes.width, planes.height}) return agreement(planes.objectId);
  Labels seen(planes.width, planes.height, 0u);
  for (int y = known.y; y < known.y + known.height; ++y)
    for (int x = known.x; x < known.x + known.width; ++x) seen(x, y) = planes.objectId(x, y);
  return agreement(seen);
}

std::string misfit(const HeldMap& held, const FramePlan& plan, const FramePlanes& planes) {
  const MapAgreement found = agreementWith(held, plan, planes);
  if (!found.contradicts()) return "";
  if (found.emptyThoughHidden())
    return fmt::format(
        "{} does not fit its masks: it holds nothing, though they hide {} places, wholly or in "
        "part",
        held.name, found.hidden + found.partly);
  if (found.seesPastLit())
    return fmt::format(
        "{} does not fit its masks: it has {} of {} places in it that they show, as the map of "
        "another light or frame would",
        held.name, found.litOwn, found.litInside);
  return fmt::format(
      "{} does not fit its masks: it hides {} of {} places that they hide and shows {} of {} that "
      "they show, as the map of another light or frame would",
      held.name, found.hiddenInMap, found.hidden, found.litInMap, found.lit);
}

/// What speaks against using the map; "" where nothing does.
std::string faultOf(const HeldMap& held, const FramePlan& plan, const FramePlanes& planes) {
  if (isMuch(held.own.unknownTexels, texelsOf(held)))
    return fmt::format("{} is no depth (NaN or -Inf) in {} of {} texels", held.name,
                       held.own.unknownTexels, texelsOf(held));
  if (!masksAreKnown(held.own, planes.objectId.view().pixels())) return "";
  return misfit(held, plan, planes);
}

std::string fewTexels(const HeldMap& held) {
  return fmt::format(
      "NaN or -Inf in {} is taken as nothing in the light's way ({} of {} texels); export it again",
      held.name, held.own.unknownTexels, texelsOf(held));
}

bool isAskedFor(const FrameLight& light) {
  return entryOf(light.method).needs.depthMap && !light.automatic;
}

std::string consequence(const FrameLight& light, bool aside) {
  if (aside)
    return "it is set aside, and the masks alone make the shadow; export both together, or say "
           "light_shape.depth_map = false";
  if (!isAskedFor(light))
    return "it is used all the same, for nothing else makes the shadow; export it again";
  return fmt::format(
      "it is used all the same, for shadow.method is \"{}\"; export both together, or take "
      "\"auto\", which sets such a map aside",
      entryOf(light.method).name);
}

}  // namespace

std::vector<std::string> setDoubtedMapsAside(const FramePlan& plan, FramePlanes& planes) {
  std::vector<std::string> doubts;
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    const FrameLight& light = plan.lights[i];
    LightPlanes& own = planes.lights[i];
    if (own.depthMap.empty()) continue;
    const HeldMap held{
        light, own,
        fmt::format("the depth map of light {} ({})", light.name, light.depthMap->file.string())};
    const std::string fault = faultOf(held, plan, planes);
    if (fault.empty()) {
      if (own.unknownTexels > 0) doubts.push_back(fewTexels(held));
      continue;
    }
    const bool aside = !own.masks.empty() && !isAskedFor(light);
    doubts.push_back(fmt::format("{}; {}", fault, consequence(light, aside)));
    if (aside) own.depthMap = Floats();
  }
  return doubts;
}

}  // namespace kagefude
