#include "picture/picture_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "base/error.h"
#include "base/nearest_name.h"

namespace kagefude {
namespace {

using enum SampleDepth;

constexpr PictureFormat formats[] = {
    {"openexr", {".exr"}, FormatAlpha::associated, {half, single}},
    {"tiff", {".tif", ".tiff"}, FormatAlpha::associated, {uint16, uint8, single}},
    {"png", {".png"}, FormatAlpha::straight, {uint16, uint8}},
    {"dpx", {".dpx"}, FormatAlpha::associated, {uint10, uint8, uint12, uint16}},
    {"jpeg", {".jpg", ".jpeg"}, FormatAlpha::none, {uint8}, 65500},
    {"webp", {".webp"}, FormatAlpha::straight, {uint8}, 16383},
};

std::vector<std::string> suffixes() {
  std::vector<std::string> all;
  for (const PictureFormat& format : formats)
    for (const std::string_view suffix : format.suffixes)
      if (!suffix.empty()) all.emplace_back(suffix);
  return all;
}

}  // namespace

int mostOf(SampleDepth depth) {
  switch (depth) {
    case uint10:
      return 1023;
    case uint12:
      return 4095;
    case uint16:
      return 65535;
    default:
      return 255;
  }
}

std::span<const PictureFormat> pictureFormats() { return formats; }

std::string listSuffixes() { return listNames(suffixes()); }

const PictureFormat& formatOf(const std::filesystem::path& file, std::string_view option) {
  std::string own = file.extension().string();
  std::transform(own.begin(), own.end(), own.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const PictureFormat& format : formats)
    for (const std::string_view suffix : format.suffixes)
      if (!own.empty() && own == suffix) return format;
  const std::string found =
      own.empty() ? "the name has no suffix" : fmt::format("no pictures are written as {}", own);
  throw UsageError(fmt::format("{} {}: {}{}; the suffix says the format: {}", option, file.string(),
                               found, own.empty() ? "" : didYouMean(own, suffixes()),
                               listSuffixes()));
}

FormatAlpha alphaFor(const PictureFormat& format, SampleDepth depth) {
  return format.name == "dpx" && depth == uint10 ? FormatAlpha::none : format.alpha;
}

SampleDepth depthFor(const PictureFormat& format, SampleDepth asked) {
  if (asked == automatic) return format.depths.front();
  std::vector<std::string> held;
  for (const SampleDepth depth : format.depths) {
    if (depth == asked) return asked;
    if (depth != automatic) held.emplace_back(sampleDepthName(depth));
  }
  throw LookError(fmt::format("output.colour = \"{}\" does not go into {} files, which hold {}",
                              sampleDepthName(asked), format.suffixes.front(), listNames(held)));
}

}  // namespace kagefude
