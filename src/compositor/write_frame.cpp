#include "compositor/write_frame.h"

#include <algorithm>

#include "compositor/scale_down.h"
#include "exr/read_channels.h"
#include "exr/write_image.h"

namespace kagefude {
namespace {

bool isResultName(const std::string& name, const std::vector<OutputChannel>& own) {
  return std::any_of(own.begin(), own.end(),
                     [&](const OutputChannel& channel) { return channel.name == name; });
}

std::vector<RawPlane> readOthers(const FramePlan& plan, const std::vector<OutputChannel>& own) {
  std::vector<std::string> names;
  for (const Channel& channel : plan.image.channels)
    if (!isResultName(channel.name, own)) names.push_back(channel.name);
  return readRaw(plan.image, names);
}

}  // namespace

void writeFrame(const Look& look, const FramePlan& plan, const FrameResult& result,
                const std::filesystem::path& path,
                const std::map<std::string, std::string>& attributes) {
  OutputImage image;
  const int scale = look.output.scale;
  const Downscale squares(plan.image.dataWindow, scale);
  image.dataWindow = squares.window();
  image.displayWindow = Downscale(plan.image.displayWindow, scale).window();
  image.pixelAspect = plan.image.pixelAspect;
  image.compression = look.output.compression;
  image.source = &plan.image;
  image.allParts = look.output.passthrough;
  image.attributes = attributes;
  const PixelType colour =
      look.output.colour == SampleDepth::single ? PixelType::single : PixelType::half;
  image.channels = {
      floatChannel("R", colour, result.colour.x), floatChannel("G", colour, result.colour.y),
      floatChannel("B", colour, result.colour.z), floatChannel("A", colour, result.alpha)};
  for (const NamedPlane& layer : result.layers)
    image.channels.push_back(layer.plane.labels.empty()
                                 ? floatChannel(layer.name, PixelType::single, layer.plane.floats)
                                 : labelChannel(layer.name, layer.plane.labels));
  std::vector<RawPlane> others;
  if (look.output.passthrough) {
    others = readOthers(plan, image.channels);
    if (scale > 1) scaleDown(squares, scale, result.standing, plan, others);
    for (const RawPlane& plane : others) image.channels.push_back(rawChannel(plane));
  }
  writeExr(path, image);
}

}  // namespace kagefude
