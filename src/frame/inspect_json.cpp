#include <array>
#include <nlohmann/json.hpp>

#include "frame/inspect_frame.h"

namespace kagefude {
namespace {

using nlohmann::json;

json windowJson(const Window& window) {
  return {{"x", window.x}, {"y", window.y}, {"width", window.width}, {"height", window.height}};
}

json partsJson(const Inspection& inspection) {
  json list = json::array();
  for (const Part& part : inspection.parts) {
    list.push_back({{"name", part.name},
                    {"dataWindow", windowJson(part.dataWindow)},
                    {"compression", part.compression},
                    {"tiled", part.tiled}});
  }
  return list;
}

json layersJson(const Inspection& inspection) {
  json list = json::array();
  for (const InspectedLayer& layer : inspection.layers) {
    json passes = json::array();
    for (const InspectedPass& pass : layer.passes) {
      passes.push_back({{"name", pass.name}, {"channels", pass.channels}, {"type", pass.type}});
    }
    list.push_back({{"name", layer.name}, {"passes", std::move(passes)}});
  }
  return list;
}

json aovsJson(const Inspection& inspection) {
  json list = json::array();
  for (const InspectedAov& aov : inspection.aovs) {
    list.push_back({{"purpose", aov.purpose}, {"key", aov.key}, {"pass", aov.pass}});
  }
  return list;
}

json cryptomattesJson(const Inspection& inspection) {
  json list = json::array();
  for (const InspectedCryptomatte& found : inspection.cryptomattes) {
    list.push_back({{"name", found.name}, {"ranks", found.ranks}, {"names", found.names}});
  }
  return list;
}

json lightsJson(const Inspection& inspection) {
  json list = json::array();
  for (const InspectedLight& light : inspection.lights) {
    json masks = json::array();
    for (const InspectedMask& mask : light.masks) {
      masks.push_back({{"layer", mask.layer}, {"found", mask.found}});
    }
    list.push_back({{"name", light.name},
                    {"type", light.type},
                    {"arrangement", light.arrangement},
                    {"masks", std::move(masks)},
                    {"depthMap", light.depthMap},
                    {"depthMapFound", light.depthMapFound},
                    {"truthLayer", light.truthLayer}});
  }
  return list;
}

json objectsJson(const Inspection& inspection) {
  json list = json::array();
  for (const InspectedObject& object : inspection.objects) {
    list.push_back(
        {{"name", object.name}, {"index", object.index}, {"materials", object.materials}});
  }
  return list;
}

json findingsJson(const Inspection& inspection) {
  constexpr std::array<const char*, 3> kinds = {"missing", "warning", "error"};
  json list = json::array();
  for (const Finding& finding : inspection.findings) {
    list.push_back({{"kind", kinds[static_cast<size_t>(finding.kind)]},
                    {"what", finding.what},
                    {"remedy", finding.remedy}});
  }
  return list;
}

}  // namespace

json toJson(const Inspection& inspection) {
  json result = {{"path", inspection.path.string()},
                 {"dataWindow", windowJson(inspection.dataWindow)},
                 {"displayWindow", windowJson(inspection.displayWindow)},
                 {"pixelAspect", inspection.pixelAspect},
                 {"channelCount", inspection.channelCount},
                 {"views", inspection.views},
                 {"view", inspection.view},
                 {"sidecar", inspection.sidecar},
                 {"frame", nullptr},
                 {"fps", nullptr}};
  if (inspection.frame) result["frame"] = *inspection.frame;
  if (inspection.fps) result["fps"] = *inspection.fps;
  result["parts"] = partsJson(inspection);
  result["layers"] = layersJson(inspection);
  result["aovs"] = aovsJson(inspection);
  result["cryptomattes"] = cryptomattesJson(inspection);
  result["lights"] = lightsJson(inspection);
  result["objects"] = objectsJson(inspection);
  result["findings"] = findingsJson(inspection);
  return result;
}

}  // namespace kagefude
