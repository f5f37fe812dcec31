#include "exr/image_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/error.h"

namespace kagefude {
namespace {

constexpr std::array<std::string_view, 10> compressionNames = {
    "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};

std::string nameOf(Imf::Compression compression) {
  const auto index = static_cast<size_t>(compression);
  return std::string(index < compressionNames.size() ? compressionNames[index] : "unknown");
}

Window windowOf(const Imath::Box2i& box) {
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
  part.dataWindow = windowOf(header.dataWindow());
  part.compression = nameOf(header.compression());
  part.tiled = header.hasTileDescription();
  const bool loss = part.compression.starts_with("dwa");
  checkClaim(path, part.dataWindow.width, part.dataWindow.height, bytesPerPixel, fileBytes, loss);
  return part;
}

void addChannels(ImageFile& file, const Imf::Header& header, int part,
                 std::set<std::string>& used) {
  const std::string& layer = file.parts[static_cast<size_t>(part)].name;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const std::string inPart = c.name();
    std::string name = inPart;
    const bool bare = inPart.find('.') == std::string::npos;
    const bool taken = used.contains(name);
    if (part > 0 && !layer.empty() && (bare || taken)) name = layer + "." + inPart;
    if (used.contains(name)) name = fmt::format("part{}.{}", part, inPart);
    used.insert(name);
    file.channels.push_back({name, inPart, typeOf(c.channel().type), part});
  }
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
  std::error_code problem;
  const uint64_t fileBytes = std::filesystem::file_size(path, problem);
  if (problem) {
    throw InputError(fmt::format("{} cannot be read: {}", path.string(), problem.message()));
  }
  ImageFile file;
  file.path = path;
  auto headers = std::make_shared<std::vector<Imf::Header>>(readHeaders(path));
  std::set<std::string> used;
  for (size_t i = 0; i < headers->size(); ++i) {
    file.parts.push_back(describePart(path, (*headers)[i], fileBytes));
    addChannels(file, (*headers)[i], static_cast<int>(i), used);
  }
  constexpr size_t mostChannels = 4096;
  if (file.channels.size() > mostChannels) {
    throw InputError(fmt::format("{} has {} channels; at most {} are allowed", path.string(),
                                 file.channels.size(), mostChannels));
  }
  if (file.channels.empty()) throw InputError(fmt::format("{} has no channels", path.string()));
  const Imf::Header& first = headers->front();
  file.dataWindow = file.parts.front().dataWindow;
  file.displayWindow = windowOf(first.displayWindow());
  file.width = file.dataWindow.width;
  file.height = file.dataWindow.height;
  file.pixelAspect = first.pixelAspectRatio();
  file.compression = file.parts.front().compression;
  file.headers = std::move(headers);
  return file;
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
  for (const Imf::Header& header : *headers) {
    const auto* found =
        header.findTypedAttribute<Imf::StringAttribute>(std::string(attribute).c_str());
    if (found) return found->value();
  }
  return std::nullopt;
}

std::vector<std::string> ImageFile::textNames() const {
  std::set<std::string> names;
  for (const Imf::Header& header : *headers) {
    for (auto a = header.begin(); a != header.end(); ++a) {
      if (dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) names.insert(a.name());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace kagefude
