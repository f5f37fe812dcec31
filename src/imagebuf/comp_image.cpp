#include "imagebuf/comp_image.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "compositor/compose_frame.h"
#include "compositor/look_colour.h"
#include "compositor/read_frame.h"
#include "frame/frame_view.h"
#include "image/downscale.h"
#include "imagebuf/image_of_buffer.h"

namespace kagefude {
namespace {

void setChannel(OIIO::ImageBuf& image, int channel, const float* values) {
  OIIO::ROI roi = image.roi();
  roi.chbegin = channel;
  roi.chend = channel + 1;
  if (!image.set_pixels(roi, OIIO::TypeFloat, values)) throw OutputError(image.geterror());
}

std::vector<float> numbersOf(View<const uint32_t> labels) {
  return {labels.data, labels.data + labels.pixels()};
}

/// The frame's own header with other channels and windows.
OIIO::ImageSpec specOf(const OIIO::ImageSpec& frame, const FramePlan& plan,
                       const FrameResult& result, int scale) {
  OIIO::ImageSpec spec = frame;
  const Window data = Downscale(plan.image.dataWindow, scale).window();
  const Window display = Downscale(plan.image.displayWindow, scale).window();
  spec.set_format(OIIO::TypeFloat);
  spec.channelformats.clear();
  spec.x = data.x;
  spec.y = data.y;
  spec.width = data.width;
  spec.height = data.height;
  spec.full_x = display.x;
  spec.full_y = display.y;
  spec.full_width = display.width;
  spec.full_height = display.height;
  spec.tile_width = spec.tile_height = spec.tile_depth = 0;
  spec.channelnames = {"R", "G", "B", "A"};
  for (const NamedPlane& layer : result.layers) spec.channelnames.push_back(layer.name);
  spec.nchannels = static_cast<int>(spec.channelnames.size());
  spec.alpha_channel = 3;
  spec.z_channel = -1;
  return spec;
}

}  // namespace

ImageComp::ImageComp(Look look)
    : look_(std::move(look)), colour_(colourOf(look_)), strips_(look_, colour_) {}

OIIO::ImageBuf ImageComp::comp(const OIIO::ImageBuf& frame, int number,
                               const std::filesystem::path& sidecar,
                               std::vector<std::string>* warnings) const {
  const std::filesystem::path own = std::string(frame.name());
  std::optional<Sidecar> scene;
  if (!sidecar.empty())
    scene = readSidecar(sidecar);
  else if (!own.empty())
    scene = findSidecar(own);
  const FramePlan plan = planOpenFrame(look_, takeView(imageOfBuffer(frame), look_.frame.view),
                                       std::move(scene), number);
  const FrameResult result = composeFrame(look_, strips_, plan, readFramePlanes(plan));
  if (warnings) *warnings = result.warnings;
  OIIO::ImageBuf image(specOf(frame.spec(), plan, result, look_.output.scale));
  int channel = 0;
  for (const Floats* plane : {&result.colour.x, &result.colour.y, &result.colour.z, &result.alpha})
    setChannel(image, channel++, View<const float>(*plane).data);
  for (const NamedPlane& layer : result.layers) {
    if (layer.plane.labels.empty())
      setChannel(image, channel++, View<const float>(layer.plane.floats).data);
    else
      setChannel(image, channel++, numbersOf(layer.plane.labels).data());
  }
  return image;
}

}  // namespace kagefude
