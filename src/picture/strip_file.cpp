#include "picture/strip_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/plain_file.h"
#include "exr/image_file.h"
#include "exr/read_channels.h"
#include "picture/picture_file.h"
#include "picture/png_file.h"
#include "picture/turn_picture.h"

namespace kagefude {
namespace {

constexpr int64_t mostPixels = int64_t{1} << 26;

/// A file, and what messages call it.
struct Source {
  const std::filesystem::path& path;
  std::string_view what;
};

[[noreturn]] void refuse(const Source& source, const std::string& why) {
  throw InputError(fmt::format("{} {} {}", source.what, source.path.string(), why));
}

/// Of the pictures beside it the one whose name is nearest, as a question; suffixes do not count.
std::string nearestFile(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  std::error_code failed;
  const std::filesystem::path folder = path.parent_path().empty() ? "." : path.parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
    files.push_back(entry.path().filename());
  std::sort(files.begin(), files.end());
  std::vector<std::string> stems;
  for (const std::filesystem::path& file : files) stems.push_back(file.stem().string());
  const std::optional<std::string> nearest = nearestName(path.stem().string(), stems);
  if (!nearest) return "";
  const auto found = std::find(stems.begin(), stems.end(), *nearest) - stems.begin();
  return fmt::format(" (did you mean {}?)", files[static_cast<size_t>(found)].string());
}

/// Before anything of the picture's size is allocated.
void requireSize(const Source& source, int width, int height) {
  if (int64_t{width} * height > mostPixels)
    refuse(source,
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
StripPicture readExrStrip(const Source& source) {
  const ImageFile image = openImage(source.path);
  requireSize(source, image.width, image.height);
  std::vector<std::string> names = {"R", "G", "B"};
  for (const std::string& name : names)
    if (!image.findChannel(name)) {
      const std::vector<std::string> all = image.channelNames();
      const auto grey =
          std::find_if(all.begin(), all.end(), [](const std::string& n) { return n != "A"; });
      if (grey == all.end()) refuse(source, "has no colour, only alpha");
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
  strip.associated = true;
  strip.sceneLinear = true;
  return strip;
}

/// Names that files give to what is linear, and to what was made for a display of sRGB.
bool saysLinear(const std::string& space) {
  return space == "Linear" || space == "linear" || space == "lin_srgb" || space == "scene_linear";
}

/// Which channels are red, green, blue and, unless it is -1, alpha: by their places, as all formats
/// but EXR have them.
std::array<int, 4> placesIn(const Source& source, const PictureHeader& header) {
  const auto count = static_cast<int>(header.channels.size());
  if (count > 4) refuse(source, fmt::format("has {} channels; a picture has 1 to 4", count));
  const bool hasAlpha = count == 2 || count == 4;
  const int alpha = hasAlpha ? count - 1 : -1;
  if (header.alpha != alpha)
    refuse(source,
           fmt::format("has {} channels, and {}; expected grey or red, green, blue, and then "
                       "alpha",
                       count,
                       header.alpha < 0 ? std::string("none of them is called alpha")
                                        : fmt::format("number {} is alpha", header.alpha + 1)));
  return count < 3 ? std::array{0, 0, 0, alpha} : std::array{0, 1, 2, alpha};
}

StripPicture readOtherStrip(const Source& source) {
  PictureFile file(source.path, mostPixels);
  const PictureHeader& header = file.header();
  const std::array<int, 4> places = placesIn(source, header);
  const int width = header.dataWindow.width, height = header.dataWindow.height;
  std::vector<Floats> channels;
  std::vector<PicturePlane> planes;
  for (int c = 0; c < static_cast<int>(header.channels.size()); ++c) {
    channels.emplace_back(width, height);
    planes.push_back({c, channels.back(), {}, {}});
  }
  file.read(planes);
  const auto upright = [&](int place) {
    return turnedUpright(channels[static_cast<size_t>(place)].clone(), header.orientation);
  };
  StripPicture strip;
  strip.red = upright(places[0]);
  strip.green = upright(places[1]);
  strip.blue = upright(places[2]);
  strip.hasAlpha = places[3] >= 0;
  strip.alpha = strip.hasAlpha ? upright(places[3]) : Floats(strip.width(), strip.height(), 1.0f);
  strip.associated = strip.hasAlpha && !header.unassociated;
  strip.space = header.colourSpace;
  const SampleType type = header.channels.front().type;
  strip.sceneLinear = strip.space.empty() ? type == SampleType::half || type == SampleType::single
                                          : saysLinear(strip.space);
  return strip;
}

}  // namespace

StripPicture readStrip(const std::filesystem::path& path, std::string_view what) {
  const Source source{path, what};
  std::error_code missing;
  if (!std::filesystem::exists(path, missing)) refuse(source, "does not exist" + nearestFile(path));
  requirePlainFile(path);
  if (startsWith(path, {0x89, 'P', 'N', 'G'})) return readPngStrip(path);
  if (startsWith(path, {0x76, 0x2f, 0x31, 0x01})) return readExrStrip(source);
  return readOtherStrip(source);
}

}  // namespace kagefude
