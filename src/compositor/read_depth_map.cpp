#include "compositor/read_depth_map.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/place_error.h"
#include "exr/read_channels.h"
#include "frame/frame_view.h"
#include "frame/sanitise.h"

namespace kagefude {
namespace {

Floats readMap(const DepthMapSource& source) {
  const ImageFile image = openFrame(source.file);
  std::string channel = source.channel;
  if (channel.empty() || !image.findChannel(channel))
    channel = requireAov(image, {}, AovKind::depth).channels.at(0);
  return std::move(readFloats(image, std::vector{channel}).at(0));
}

bool isGone(const DepthMapSource& source) {
  std::error_code unknown;
  return !std::filesystem::exists(source.file, unknown);
}

const char* projectionName(bool perspective) {
  return perspective ? "perspective" : "orthographic";
}

void doubtDescription(const FrameLight& light, const Floats& map,
                      std::vector<std::string>& warnings) {
  const DepthMapSource& source = *light.depthMap;
  if (!source.said) return;
  const auto& [width, height, perspective] = *source.said;
  if (width != map.width() || height != map.height())
    warnings.push_back(
        fmt::format("the depth map {} of light {} has {} x {} texels, but the frame's JSON says {} "
                    "x {}; use the map and the JSON that were exported together",
                    source.file.string(), light.name, map.width(), map.height(), width, height));
  const bool byMatrix = source.clipFromLight.m[3][2] != 0;
  if (perspective != byMatrix)
    warnings.push_back(fmt::format(
        "the frame's JSON calls the depth map of light {} {}, but its clip_from_light is {}, as "
        "which it is taken; export the frame again",
        light.name, projectionName(perspective), projectionName(byMatrix)));
}

}  // namespace

void readDepthMapOf(const FrameLight& light, LightPlanes& planes,
                    std::vector<std::string>& warnings) {
  const bool pair =
      light.method == ShadowMethod::pair && light.depthMap && light.passes.lightShape.depthMap;
  if (!light.readsDepthMap && !pair) return;
  if (!entryOf(light.method).needs.depthMap && isGone(*light.depthMap)) {
    warnings.push_back(
        fmt::format("the depth map {} of light {} does not exist, so its masks alone make its "
                    "shadow; keep it beside the frame, or set light_shape.depth_map = false",
                    light.depthMap->file.string(), light.name));
    return;
  }
  if (!light.readsDepthMap) return;
  planes.depthMap = withPlace(light.depthMap->named, [&] { return readMap(*light.depthMap); });
  planes.unknownTexels = clearNoDepth(planes.depthMap.view());
  doubtDescription(light, planes.depthMap, warnings);
}

}  // namespace kagefude
