#include "exr/image_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include "base/error.h"
#include "base/plain_file.h"
#include "exr/header_claims.h"

namespace kagefude {
namespace {

constexpr std::array<std::string_view, 10> compressionNames = {
    "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};

std::string nameOf(Imf::Compression compression) {
  const auto index = static_cast<size_t>(compression);
  return std::string(index < compressionNames.size() ? compressionNames[index] : "unknown");
}

/// Sides beyond an int become the largest int, turned windows empty.
Window clampedWindow(const Imath::Box2i& box) {
  const int64_t width = int64_t{box.max.x} - box.min.x + 1;
  const int64_t height = int64_t{box.max.y} - box.min.y + 1;
  constexpr int64_t most = INT32_MAX;
  return {box.min.x, box.min.y, static_cast<int>(std::clamp<int64_t>(width, 0, most)),
          static_cast<int>(std::clamp<int64_t>(height, 0, most))};
}

int64_t sizeOf(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

PixelType typeOf(Imf::PixelType type) {
  switch (type) {
    case Imf::HALF:
      return PixelType::half;
    case Imf::UINT:
      return PixelType::uint;
    default:
      return PixelType::single;
  }
}

std::vector<Imf::Header> readHeaders(const std::filesystem::path& path) {
  try {
    // Chunk tables are not rebuilt when they are damaged: a file with holes is an error anyway.
    const Imf::MultiPartInputFile input(path.c_str(), 0, false);
    std::vector<Imf::Header> headers;
    for (int i = 0; i < input.parts(); ++i) headers.push_back(input.header(i));
    return headers;
  } catch (const std::exception& problem) {
    throw InputError(
        fmt::format("{} cannot be read as an EXR file: {}", path.string(), problem.what()));
  }
}

/// OpenEXR allocates some tiles before it reads one, and a tile may be larger than the picture.
void checkTileClaim(const std::filesystem::path& path, const Imf::Header& header,
                    const Window& window, int64_t bytesPerPixel) {
  if (!header.hasTileDescription()) return;
  constexpr uint64_t longestSide = uint64_t{1} << 17, harmless = uint64_t{64} << 20;
  const Imf::TileDescription& tile = header.tileDescription();
  const uint64_t pixelBytes = static_cast<uint64_t>(bytesPerPixel);
  const bool absurd = tile.xSize > longestSide || tile.ySize > longestSide;
  const uint64_t bytes = absurd ? 0 : uint64_t{tile.xSize} * tile.ySize * pixelBytes;
  const uint64_t whole = static_cast<uint64_t>(window.pixels()) * pixelBytes;
  if (absurd || bytes > std::max(harmless, whole)) {
    throw InputError(
        fmt::format("{} claims tiles of {} x {} pixels in a picture of {} x {}; at most the "
                    "picture's size or 64 MiB are allowed",
                    path.string(), tile.xSize, tile.ySize, window.width, window.height));
  }
}

Part describePart(const std::filesystem::path& path, const Imf::Header& header,
                  uint64_t fileBytes) {
  if (header.hasType() && Imf::isDeepData(header.type())) {
    throw InputError(fmt::format(
        "{} is a deep file, which has many samples in a pixel; flatten it before the comp",
        path.string()));
  }
  int64_t bytesPerPixel = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    bytesPerPixel += sizeOf(c.channel().type);
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
      throw InputError(
          fmt::format("{} has the subsampled channel {}; every pixel needs its own sample",
                      path.string(), c.name()));
    }
  }
  Part part;
  part.name = header.hasName() ? header.name() : "";
  part.view = header.hasView() ? header.view() : "";
  part.dataWindow = clampedWindow(header.dataWindow());
  part.compression = nameOf(header.compression());
  part.tiled = header.hasTileDescription();
  part.file = path;
  const bool loss = part.compression.starts_with("dwa");
  checkClaim(path, part.dataWindow.width, part.dataWindow.height, bytesPerPixel, fileBytes, loss);
  checkTileClaim(path, header, part.dataWindow, bytesPerPixel);
  return part;
}

bool isSeparator(char c) { return c == '.' || c == '_' || c == '-' || c == ' '; }

// A part's name without the view that its header gives: "rgba.right", "right_rgba" and "rgba" of
// view right are all "rgba", "right" is "".
std::string withoutView(const std::string& name, const std::string& view) {
  if (view.empty() || name == view) return view.empty() ? name : "";
  const size_t rest = name.size() - std::min(name.size(), view.size() + 1);
  if (rest > 0 && name.ends_with(view) && isSeparator(name[rest])) return name.substr(0, rest);
  if (rest > 0 && name.starts_with(view) && isSeparator(name[view.size()]))
    return name.substr(view.size() + 1);
  return name;
}

// "N.X" of view right is "N.right.X"; names that say their view already stay.
std::string withView(const std::string& name, const std::string& view) {
  const auto dotted = "." + name + ".";
  if (dotted.find("." + view + ".") != std::string::npos) return name;
  const size_t dot = name.rfind('.');
  if (dot == std::string::npos) return view + "." + name;
  return name.substr(0, dot) + "." + view + name.substr(dot);
}

void addPartChannels(ImageFile& file, const Imf::Header& header, int part) {
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    file.channels.push_back({c.name(), c.name(), typeOf(c.channel().type), part});
}

// Gives every channel its layer from its part, its view, and last a number where that leaves two
// of one name.
void nameChannels(ImageFile& file) {
  if (file.parts.size() < 2) return;
  std::map<std::pair<std::string, std::string>, int> uses;
  const auto partOf = [&](const Channel& c) -> const Part& {
    return file.parts[static_cast<size_t>(c.part)];
  };
  for (const Channel& c : file.channels) ++uses[{partOf(c).view, c.name}];
  std::set<std::string> used;
  for (Channel& c : file.channels) {
    const Part& part = partOf(c);
    const std::string layer = withoutView(part.name, part.view);
    const size_t dot = c.nameInPart.rfind('.');
    const bool bare = dot == std::string::npos ||
                      (dot == part.view.size() && c.nameInPart.starts_with(part.view));
    if (!layer.empty() && (bare || uses[{part.view, c.nameInPart}] > 1))
      c.name = layer + "." + c.nameInPart;
    if (!part.view.empty() && part.view != file.parts.front().view)
      c.name = withView(c.name, part.view);
    if (used.contains(c.name)) c.name = fmt::format("part{}.{}", c.part, c.nameInPart);
    used.insert(c.name);
  }
}

Window join(const Window& a, const Window& b) {
  const int64_t x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  const int64_t right = std::max(int64_t{a.x} + a.width, int64_t{b.x} + b.width);
  const int64_t bottom = std::max(int64_t{a.y} + a.height, int64_t{b.y} + b.height);
  constexpr int64_t most = INT32_MAX;
  return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(std::min(right - x, most)),
          static_cast<int>(std::min(bottom - y, most))};
}

}  // namespace

std::string_view pixelTypeName(PixelType type) {
  constexpr std::array<std::string_view, 3> names = {"half", "float", "uint"};
  return names[static_cast<size_t>(type)];
}

void checkClaim(const std::filesystem::path& path, int64_t width, int64_t height,
                int64_t bytesPerPixel, uint64_t fileBytes, bool packedWithLoss) {
  constexpr int64_t longestSide = int64_t{1} << 17, mostPixels = int64_t{1} << 30;
  constexpr uint64_t harmless = uint64_t{64} << 20;
  if (width < 1 || height < 1 || width > longestSide || height > longestSide ||
      width * height > mostPixels) {
    throw InputError(
        fmt::format("{} claims {} x {} pixels; sides of 1 to {} and at most {} pixels are allowed",
                    path.string(), width, height, longestSide, mostPixels));
  }
  const uint64_t raw = static_cast<uint64_t>(width * height) * static_cast<uint64_t>(bytesPerPixel);
  const uint64_t ratio = packedWithLoss ? 40000 : 2000;
  if (raw > harmless && raw / ratio > fileBytes) {
    throw InputError(
        fmt::format("{} claims {} x {} pixels ({} MiB), which its {} bytes cannot hold",
                    path.string(), width, height, raw >> 20, fileBytes));
  }
}

ImageFile openImage(const std::filesystem::path& path) {
  const uint64_t fileBytes = requirePlainFile(path);
  checkHeaderClaims(path, fileBytes);
  ImageFile file;
  file.path = path;
  auto headers = std::make_shared<std::vector<Imf::Header>>(readHeaders(path));
  for (size_t i = 0; i < headers->size(); ++i) {
    file.parts.push_back(describePart(path, (*headers)[i], fileBytes));
    file.parts.back().place = static_cast<int>(i);
    addPartChannels(file, (*headers)[i], static_cast<int>(i));
  }
  nameChannels(file);
  constexpr size_t mostChannels = 4096;
  if (file.channels.size() > mostChannels) {
    throw InputError(fmt::format("{} has {} channels; at most {} are allowed", path.string(),
                                 file.channels.size(), mostChannels));
  }
  if (file.channels.empty()) throw InputError(fmt::format("{} has no channels", path.string()));
  file.headers = std::move(headers);
  file.ownParts.resize(file.parts.size());
  std::iota(file.ownParts.begin(), file.ownParts.end(), 0);
  describeOwnParts(file);
  // One plane of the joined window: parts that lie far apart claim what none of them does.
  if (file.parts.size() > 1) checkClaim(path, file.width, file.height, 4, fileBytes);
  return file;
}

ImageFile joinImages(std::vector<ImageFile> images, const std::vector<std::string>& layers) {
  ImageFile all;
  all.path = images.front().path;
  auto headers = std::make_shared<std::vector<Imf::Header>>();
  uint64_t bytes = 0;
  for (size_t i = 0; i < images.size(); ++i) {
    ImageFile& image = images[i];
    const Window &first = images.front().displayWindow, &own = image.displayWindow;
    if (own != first)
      throw InputError(fmt::format(
          "{} is a picture of {} x {} at ({}, {}), but {} is one of {} x {} at ({}, {}); the files "
          "of a frame have one size",
          image.path.string(), own.width, own.height, own.x, own.y, all.path.string(), first.width,
          first.height, first.x, first.y));
    bytes += std::filesystem::file_size(image.path);
    const auto offset = static_cast<int>(all.parts.size());
    if (image.parts.size() == 1) image.parts.front().name = layers[i];
    for (Channel channel : image.channels) {
      channel.part += offset;
      channel.name = channel.nameInPart;
      all.channels.push_back(std::move(channel));
    }
    all.parts.insert(all.parts.end(), image.parts.begin(), image.parts.end());
    headers->insert(headers->end(), image.headers->begin(), image.headers->end());
  }
  all.headers = std::move(headers);
  nameChannels(all);
  all.ownParts.resize(all.parts.size());
  std::iota(all.ownParts.begin(), all.ownParts.end(), 0);
  describeOwnParts(all);
  checkClaim(all.path, all.width, all.height, 4, bytes);
  return all;
}

void describeOwnParts(ImageFile& file) {
  const Part& first = file.parts[static_cast<size_t>(file.ownParts.front())];
  file.dataWindow = first.dataWindow;
  for (const int part : file.ownParts)
    file.dataWindow = join(file.dataWindow, file.parts[static_cast<size_t>(part)].dataWindow);
  file.width = file.dataWindow.width;
  file.height = file.dataWindow.height;
  file.compression = first.compression;
  file.displayWindow = clampedWindow(file.leadingHeader().displayWindow());
  file.pixelAspect = file.leadingHeader().pixelAspectRatio();
}

const Channel* ImageFile::findChannel(std::string_view name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const Channel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

std::vector<std::string> ImageFile::channelNames() const {
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  return names;
}

std::optional<std::string> ImageFile::text(std::string_view attribute) const {
  for (const int part : ownParts)
    if (auto found = textOfPart(part, attribute)) return found;
  return std::nullopt;
}

std::optional<std::string> ImageFile::textOfPart(int part, std::string_view attribute) const {
  const Imf::Header& header = (*headers)[static_cast<size_t>(part)];
  const auto* found =
      header.findTypedAttribute<Imf::StringAttribute>(std::string(attribute).c_str());
  return found ? std::optional(found->value()) : std::nullopt;
}

std::vector<std::string> ImageFile::textNames(int part) const {
  std::vector<std::string> names;
  const Imf::Header& header = (*headers)[static_cast<size_t>(part)];
  for (auto a = header.begin(); a != header.end(); ++a)
    if (dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) names.emplace_back(a.name());
  std::sort(names.begin(), names.end());
  return names;
}

const Imf::Header& ImageFile::leadingHeader() const {
  return (*headers)[static_cast<size_t>(ownParts.front())];
}

}  // namespace kagefude
