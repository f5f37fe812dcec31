#include "live/probe.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kagefude {
namespace {

using Json = nlohmann::ordered_json;

std::string nameOf(const std::map<uint32_t, std::string>& names, uint32_t id) {
  const auto found = names.find(id);
  return found == names.end() ? fmt::format("{:08x}", id) : found->second;
}

}  // namespace

Json probe(const LivePicture& picture, int x, int y) {
  const StagedFrame& frame = picture.stages;
  const FramePlanes& planes = *frame.planes;
  Json result{{"x", x}, {"y", y}, {"object", nullptr}};
  if (!planes.objectId.view().contains(x, y)) return result;
  const StyledSurfaces& styled = frame.styles->surfaces;
  const uint16_t anchor = styled.anchorIndex(x, y);
  if (anchor == 0) return result;
  result["object"] = nameOf(picture.plan->objectNames, planes.objectId(x, y));
  if (!planes.materialId.empty())
    result["material"] = nameOf(picture.plan->materialNames, planes.materialId(x, y));
  const int style = styled.styles[anchor - 1u];
  if (style >= 0) result["style"] = style;
  result["strip"] = style >= 0 ? picture.look->styles[static_cast<size_t>(style)].style.strip
                               : StyleParams{}.strip;
  result["row"] = (*frame.tone)(x, y);
  result["lights"] = Json::array();
  for (const LightStagesMade& light : frame.lights)
    result["lights"].push_back({{"name", light.name},
                                {"visibility", (*light.visibility)(x, y)},
                                {"tone", (*light.tone)(x, y)}});
  return result;
}

}  // namespace kagefude
