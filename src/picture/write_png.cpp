#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/error.h"
#include "exr/write_image.h"
#include "image/parallel.h"
#include "picture/png_file.h"

namespace kagefude {
namespace {

void interleave(PngPicture& picture, View<const float> plane, int channel) {
  const float most = picture.bits == 16 ? 65535.0f : 255.0f;
  parallelRows(plane.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      uint16_t* out = picture.samples.data() +
                      static_cast<size_t>(y) * plane.width * picture.channels + channel;
      for (int x = 0; x < plane.width; ++x) {
        const float value = plane(x, y);
        // NaN fails both comparisons and becomes 0.
        const float clamped = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
        out[static_cast<size_t>(x) * picture.channels] =
            static_cast<uint16_t>(clamped * most + 0.5f);
      }
    }
  });
}

}  // namespace

void writePng(const std::filesystem::path& path, View<const float> red, View<const float> green,
              View<const float> blue, View<const float> alpha, int bits,
              const std::map<std::string, std::string>& texts) {
  std::vector<View<const float>> planes = {red, green, blue};
  if (!alpha.empty()) planes.push_back(alpha);
  for (const View<const float>& plane : planes) {
    if (plane.empty() || plane.width != red.width || plane.height != red.height) {
      throw OutputError(path.string() + " cannot be written: its planes are of different sizes");
    }
  }
  PngPicture picture{red.width, red.height, static_cast<int>(planes.size()), bits, {}};
  picture.samples.resize(red.pixels() * planes.size());
  for (size_t c = 0; c < planes.size(); ++c) interleave(picture, planes[c], static_cast<int>(c));
  AtomicFile file(path);
  std::vector<unsigned char> bytes;
  try {
    bytes = encodePng(picture, texts);
  } catch (const OutputError& problem) {
    throw OutputError(fmt::format("{} cannot be written: {}", path.string(), problem.what()));
  }
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace kagefude
