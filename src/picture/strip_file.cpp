#include "picture/strip_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "base/error.h"
#include "base/plain_file.h"
#include "exr/image_file.h"
#include "exr/read_channels.h"
#include "picture/png_file.h"

namespace kagefude {
namespace {

constexpr int64_t mostPixels = int64_t{1} << 26;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("strip {} {}", path.string(), why));
}

/// Before anything of the picture's size is allocated.
void requireSize(const std::filesystem::path& path, int width, int height) {
  if (int64_t{width} * height > mostPixels)
    refuse(path,
           fmt::format("is {} x {} pixels; at most {} are allowed", width, height, mostPixels));
}

bool startsWith(const std::filesystem::path& path, const std::array<unsigned char, 4>& magic) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> start{};
  file.read(start.data(), start.size());
  return file && std::equal(magic.begin(), magic.end(), start.begin(),
                            [](unsigned char a, char b) { return static_cast<char>(a) == b; });
}

Floats pick(const PngPicture& picture, int channel) {
  const float scale = 1.0f / static_cast<float>((1 << picture.bits) - 1);
  Floats plane(picture.width, picture.height);
  const uint16_t* sample = picture.samples.data() + channel;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, sample += picture.channels)
      plane(x, y) = static_cast<float>(*sample) * scale;
  return plane;
}

StripPicture readPngStrip(const std::filesystem::path& path) {
  const PngPicture picture = readPng(path, mostPixels);
  const bool grey = picture.channels < 3;
  StripPicture strip;
  strip.red = pick(picture, 0);
  strip.green = pick(picture, grey ? 0 : 1);
  strip.blue = pick(picture, grey ? 0 : 2);
  strip.hasAlpha = picture.channels % 2 == 0;
  strip.alpha = strip.hasAlpha ? pick(picture, picture.channels - 1)
                               : Floats(picture.width, picture.height, 1.0f);
  return strip;
}

/// R, G, B by name; a file without them is taken for grey by its first channel that is not alpha.
StripPicture readExrStrip(const std::filesystem::path& path) {
  const ImageFile image = openImage(path);
  requireSize(path, image.width, image.height);
  std::vector<std::string> names = {"R", "G", "B"};
  for (const std::string& name : names)
    if (!image.findChannel(name)) {
      const std::vector<std::string> all = image.channelNames();
      const auto grey =
          std::find_if(all.begin(), all.end(), [](const std::string& n) { return n != "A"; });
      if (grey == all.end()) refuse(path, "has no colour, only alpha");
      names.assign(3, std::string(*grey));
      break;
    }
  StripPicture strip;
  strip.hasAlpha = image.findChannel("A") != nullptr;
  if (strip.hasAlpha) names.push_back("A");
  std::vector<Floats> planes = readFloats(image, names);
  strip.red = std::move(planes[0]);
  strip.green = std::move(planes[1]);
  strip.blue = std::move(planes[2]);
  strip.alpha = strip.hasAlpha ? std::move(planes[3]) : Floats(strip.width(), strip.height(), 1.0f);
  strip.sceneLinear = true;
  return strip;
}

}  // namespace

StripPicture readStrip(const std::filesystem::path& path) {
  std::error_code missing;
  if (!std::filesystem::exists(path, missing)) refuse(path, "does not exist");
  requirePlainFile(path);
  const bool png = startsWith(path, {0x89, 'P', 'N', 'G'});
  if (!png && !startsWith(path, {0x76, 0x2f, 0x31, 0x01}))
    refuse(path, "cannot be read: it is neither a PNG nor an EXR file");
  return png ? readPngStrip(path) : readExrStrip(path);
}

}  // namespace kagefude
