#include "frame/strip_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"
#include "frame/image_file.h"
#include "frame/read_channels.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr int64_t mostPixels = int64_t{1} << 26;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("strip {} {}", path.string(), why));
}

void checkSpec(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
  if (spec.deep) refuse(path, "is a deep file; flatten it");
  if (spec.nchannels < 1 || spec.nchannels > 64) {
    refuse(path, fmt::format("has {} channels; 1 to 64 are allowed", spec.nchannels));
  }
  checkClaim(path, spec.width, spec.height, static_cast<int64_t>(spec.pixel_bytes(true)),
             std::filesystem::file_size(path));
  if (int64_t{spec.width} * spec.height > mostPixels) {
    refuse(path, fmt::format("is {} x {} pixels; at most {} are allowed", spec.width, spec.height,
                             mostPixels));
  }
}

Floats pick(const std::vector<float>& samples, const OIIO::ImageSpec& spec, int channel) {
  Floats plane(spec.width, spec.height);
  if (channel < 0) {
    plane.fill(1.0f);
    return plane;
  }
  parallelRows(spec.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const float* in = samples.data() + static_cast<size_t>(y) * spec.width * spec.nchannels;
      for (int x = 0; x < spec.width; ++x) plane(x, y) = in[x * spec.nchannels + channel];
    }
  });
  return plane;
}

int channelNamed(const OIIO::ImageSpec& spec, const char* name, int otherwise) {
  const int index = spec.channelindex(name);
  return index >= 0 ? index : otherwise;
}

}  // namespace

StripPicture readStrip(const std::filesystem::path& path) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(path, missing)) refuse(path, "does not exist");
  // OIIO would multiply colours by alpha; a strip's colours are wanted as they were painted.
  OIIO::ImageSpec hints;
  hints["oiio:UnassociatedAlpha"] = 1;
  const auto input = OIIO::ImageInput::open(path.string(), &hints);
  if (!input) refuse(path, "cannot be read: " + OIIO::geterror());
  const OIIO::ImageSpec spec = input->spec();
  checkSpec(path, spec);
  std::vector<float> samples(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, samples.data())) {
    refuse(path, "is truncated or damaged: " + input->geterror());
  }
  const bool grey = spec.nchannels < 3;
  const int alpha = spec.alpha_channel >= 0 ? spec.alpha_channel : (spec.nchannels == 2 ? 1 : -1);
  StripPicture strip;
  strip.red = pick(samples, spec, grey ? 0 : channelNamed(spec, "R", 0));
  strip.green = pick(samples, spec, grey ? 0 : channelNamed(spec, "G", 1));
  strip.blue = pick(samples, spec, grey ? 0 : channelNamed(spec, "B", 2));
  strip.alpha = pick(samples, spec, alpha);
  strip.hasAlpha = alpha >= 0;
  strip.sceneLinear = spec.format.is_floating_point();
  return strip;
}

}  // namespace kagefude
