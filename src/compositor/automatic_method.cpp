#include "compositor/automatic_method.h"

#include <filesystem>

namespace kagefude {
namespace {

bool exists(const std::optional<LightDepthMap>& map) {
  std::error_code unknown;
  return map && std::filesystem::exists(map->file, unknown);
}

ShadowMethod arrangementMethod(MaskArrangement arrangement, bool hasDepthMap) {
  switch (arrangement) {
    case MaskArrangement::pair:
      return hasDepthMap ? ShadowMethod::pairDepth : ShadowMethod::pair;
    case MaskArrangement::line:
      return ShadowMethod::line;
    case MaskArrangement::disc:
    case MaskArrangement::grid:
      return ShadowMethod::disc;
    case MaskArrangement::hard:
      return ShadowMethod::hard;
  }
  return ShadowMethod::none;
}

}  // namespace

ShadowMethod casterMethod(float radius) {
  return radius > 0.0f ? ShadowMethod::places : ShadowMethod::coverage;
}

ShadowMethod automaticMethod(const SidecarLight& source, bool mapHelps, bool hasCasters,
                             float radius) {
  if (source.masks)
    return arrangementMethod(source.masks->arrangement, mapHelps && exists(source.depthMap));
  if (!source.tracedLayer.empty()) return ShadowMethod::traced;
  if (source.depthMap) return ShadowMethod::pcf;
  return hasCasters ? casterMethod(radius) : ShadowMethod::none;
}

ShadowMethod automaticMethod(const LightParams& params, bool mapHelps, bool hasCasters) {
  if (params.masks.size() == 2)
    return mapHelps && !params.depthMap.empty() ? ShadowMethod::pairDepth : ShadowMethod::pair;
  if (params.masks.size() > 2) return ShadowMethod::disc;
  if (!params.depthMap.empty()) return ShadowMethod::pcf;
  return hasCasters ? casterMethod(params.radius) : ShadowMethod::none;
}

}  // namespace kagefude
