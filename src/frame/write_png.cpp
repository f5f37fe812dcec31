#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "frame/atomic_file.h"
#include "frame/write_image.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

template <class Sample>
void interleave(std::vector<Sample>& samples, View<const float> plane, int channel, int channels) {
  const float most = static_cast<float>(static_cast<Sample>(~Sample{0}));
  parallelRows(plane.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      Sample* out = samples.data() + static_cast<size_t>(y) * plane.width * channels + channel;
      for (int x = 0; x < plane.width; ++x) {
        const float value = plane(x, y);
        // NaN fails both comparisons and becomes 0.
        const float clamped = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
        out[static_cast<size_t>(x) * channels] = static_cast<Sample>(clamped * most + 0.5f);
      }
    }
  });
}

template <class Sample>
std::vector<unsigned char> encode(std::span<const View<const float>> planes, OIIO::TypeDesc type) {
  const int channels = static_cast<int>(planes.size());
  std::vector<Sample> samples(planes[0].pixels() * planes.size());
  for (int c = 0; c < channels; ++c)
    interleave(samples, planes[static_cast<size_t>(c)], c, channels);
  OIIO::ImageSpec spec(planes[0].width, planes[0].height, channels, type);
  spec["oiio:UnassociatedAlpha"] = 1;
  spec["oiio:ColorSpace"] = "sRGB";
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  OIIO::Filesystem::IOProxy* proxy = &memory;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const auto output = OIIO::ImageOutput::create("png");
  if (!output || !output->open("out.png", spec) || !output->write_image(type, samples.data()) ||
      !output->close()) {
    throw OutputError(output ? output->geterror() : OIIO::geterror());
  }
  return bytes;
}

}  // namespace

void writePng(const std::filesystem::path& path, View<const float> red, View<const float> green,
              View<const float> blue, View<const float> alpha, int bits) {
  std::vector<View<const float>> planes = {red, green, blue};
  if (!alpha.empty()) planes.push_back(alpha);
  for (const View<const float>& plane : planes) {
    if (plane.empty() || plane.width != red.width || plane.height != red.height) {
      throw OutputError(path.string() + " cannot be written: its planes are of different sizes");
    }
  }
  AtomicFile file(path);
  std::vector<unsigned char> bytes;
  try {
    bytes = bits == 16 ? encode<uint16_t>(planes, OIIO::TypeDesc::UINT16)
                       : encode<uint8_t>(planes, OIIO::TypeDesc::UINT8);
  } catch (const OutputError& problem) {
    throw OutputError(fmt::format("{} cannot be written: {}", path.string(), problem.what()));
  }
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace kagefude
