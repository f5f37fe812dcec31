#include "picture/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/error.h"
#include "base/plain_file.h"
#include "base/printable.h"
#include "exr/image_file.h"
#include "picture/cut_file.h"
#include "picture/shared_pixels.h"

namespace kagefude {
namespace {

/// What a decoder may take beyond the pixels and the file: code pages, tables, thread stacks.
constexpr uint64_t harmless = uint64_t{384} << 20;

struct RefusedFormat {
  std::string_view name, what;
};
constexpr RefusedFormat refusedFormats[] = {
    {"ffmpeg", "a film; write its frame as a picture"},
    {"openvdb", "a volume and no picture"},
    {"raw", "a camera's raw file; develop it to TIFF or EXR"},
    {"dicom", "a medical recording; convert it to TIFF or EXR"},
    {"null", "no picture"},
    {"term", "no picture"},
};

/// Codecs that pack even surfaces into next to nothing.
bool packsWithLoss(const std::string& format) {
  constexpr std::string_view names[] = {"jpeg", "jpeg2000", "webp", "heif"};
  return std::find(std::begin(names), std::end(names), format) != std::end(names);
}

bool isCmyk(const PictureHeader& header) {
  return std::any_of(header.attributes.begin(), header.attributes.end(), [](const auto& a) {
    return a.name.find(":Color") != std::string::npos &&
           (a.text == "CMYK" || a.text == "YCCK" || a.text == "YCbCrK" ||
            a.text == "color separated");
  });
}

/// OpenImageIO's words as a part of our sentence: one line, without the file's name.
std::string reason(const nlohmann::json& answer, const std::filesystem::path& path) {
  std::string words = answer.at("error");
  for (const std::string& name : {fmt::format("\"{}\"", path.string()), path.string()})
    for (size_t at = 0; (at = words.find(name, at)) != std::string::npos;)
      words.replace(at, name.size(), "the file");
  while (!words.empty() && (words.back() == '\n' || words.back() == '.')) words.pop_back();
  std::replace(words.begin(), words.end(), '\n', ' ');
  constexpr size_t longest = 300;
  return printable(words.substr(0, longest));
}

/// Where the program that reads pictures is not there, the picture is what matters. A file that is
/// called an EXR comes here only when it does not begin as one.
WorkerLease readerOf(const std::filesystem::path& path) {
  try {
    return WorkerLease();
  } catch (const InputError& problem) {
    const bool exr = path.extension() == ".exr" || path.extension() == ".EXR";
    throw InputError(fmt::format(
        "{} {}: {}", path.string(),
        exr ? "is no EXR file, and cannot be read as another picture" : "cannot be read",
        problem.what()));
  }
}

SharedPixels sharedPixels(const std::filesystem::path& path, size_t bytes) {
  try {
    return SharedPixels(bytes);
  } catch (const std::system_error& limit) {
    throw InputError(fmt::format("{} cannot be read: {}", path.string(), limit.what()));
  }
}

}  // namespace

void PictureFile::refuse(const std::string& why) const {
  throw InputError(fmt::format("{} {}", path_.string(), why));
}

PictureFile::PictureFile(const std::filesystem::path& path, int64_t mostPixels)
    : path_(path), fileBytes_(requirePlainFile(path)), worker_(readerOf(path)) {
  // Absolute, so that no name looks like an option of a format or an address.
  const std::string name = std::filesystem::absolute(path).string();
  // Some decoders unpack the whole picture when it is opened.
  const WorkerBounds bounds{harmless + 16 * std::min(fileBytes_, uint64_t{1} << 32)};
  const nlohmann::json answer = worker_->ask({{"do", "open"}, {"path", name}}, bounds);
  if (answer.contains("error")) refuse(fmt::format("cannot be read: {}", reason(answer, name)));
  header_ = headerFrom(answer.at("header"));
  check(mostPixels);
}

void PictureFile::check(int64_t mostPixels) const {
  for (const RefusedFormat& refused : refusedFormats)
    if (header_.format == refused.name)
      refuse(fmt::format("cannot be used: it is {} (format {})", refused.what, refused.name));
  if (header_.deep) refuse("is a deep file, which has many samples in a pixel; flatten it first");
  if (header_.depth > 1) refuse(fmt::format("is a volume of {} slices", header_.depth));
  // The first of a Photoshop file's is all of its layers together.
  if (header_.severalPictures && header_.format != "psd")
    refuse(
        fmt::format("holds several pictures (format {}); write the one that is meant to a file "
                    "of its own",
                    header_.format));
  if (isCmyk(header_))
    refuse(
        "is in CMYK, the inks of a print, whose colours only a print's profile tells; convert "
        "it to RGB");
  if (header_.channels.empty()) refuse("has no channels");
  const Window& window = header_.dataWindow;
  int64_t bytes = 0;
  for (const PictureChannel& channel : header_.channels) bytes += bytesOf(channel.type);
  checkClaim(path_, window.width, window.height, bytes, fileBytes_, packsWithLoss(header_.format));
  if (isCutShort(path_, header_, fileBytes_))
    refuse(fmt::format("is truncated: its {} bytes do not hold its {} x {} pixels", fileBytes_,
                       window.width, window.height));
  if (window.pixels() > mostPixels)
    refuse(fmt::format("is {} x {} pixels; at most {} are allowed", window.width, window.height,
                       mostPixels));
}

void PictureFile::read(std::span<const PicturePlane> planes) {
  const auto pixels = static_cast<size_t>(header_.dataWindow.pixels());
  nlohmann::json wanted = nlohmann::json::array();
  std::vector<size_t> offsets;
  size_t bytes = 0;
  for (const PicturePlane& plane : planes) {
    const int type = !plane.halves.empty() ? 0 : !plane.values.empty() ? 1 : 2;
    wanted.push_back({plane.channel, type, bytes});
    offsets.push_back(bytes);
    bytes += pixels * (type == 0 ? 2 : 4);
  }
  const SharedPixels shared = sharedPixels(path_, bytes);
  // The pixels that are asked for, twice more as the decoder and OpenImageIO hold them, and the
  // file's own of all channels.
  const uint64_t all = pixels * header_.channels.size() * 4;
  const auto answer =
      worker_->ask({{"do", "read"}, {"planes", wanted}, {"bytes", bytes}},
                   {harmless + 3 * bytes + 3 * all + 2 * fileBytes_}, shared.descriptor());
  if (answer.contains("error"))
    refuse(fmt::format("is truncated or damaged: {}",
                       reason(answer, std::filesystem::absolute(path_).string())));
  for (size_t i = 0; i < planes.size(); ++i) {
    const PicturePlane& plane = planes[i];
    void* const to = !plane.halves.empty()   ? static_cast<void*>(plane.halves.data)
                     : !plane.values.empty() ? static_cast<void*>(plane.values.data)
                                             : static_cast<void*>(plane.words.data);
    std::memcpy(to, shared.data() + offsets[i], pixels * (plane.halves.empty() ? 4 : 2));
  }
}

}  // namespace kagefude
