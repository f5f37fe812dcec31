#include "picture/frame_picture.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "base/error.h"
#include "base/plain_file.h"
#include "exr/read_channels.h"
#include "exr/reserved_attributes.h"
#include "picture/picture_file.h"

namespace kagefude {
namespace {

bool startsAsExr(const std::filesystem::path& path) {
  requirePlainFile(path);
  std::array<char, 4> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return start == std::array<char, 4>{'\x76', '\x2f', '\x31', '\x01'};
}

bool isInteger(SampleType type) { return type != SampleType::half && type != SampleType::single; }

PixelType typeOf(SampleType type) {
  if (isInteger(type)) return PixelType::uint;
  return type == SampleType::half ? PixelType::half : PixelType::single;
}

class PictureSource : public PlaneSource {
 public:
  PictureSource(std::filesystem::path path, const PictureHeader& header)
      : path_(std::move(path)), window_(header.dataWindow), channels_(header.channels) {}

  void read(std::span<const PlaneTarget> targets) const override {
    PictureFile file(path_);
    if (!isSame(file.header())) throw InputError(path_.string() + " changed while it was read");
    std::vector<PicturePlane> planes;
    for (const PlaneTarget& target : targets) {
      PicturePlane plane;
      plane.channel = placeOf(target.channel->nameInPart);
      const int w = window_.width, h = window_.height;
      if (target.type == PixelType::half)
        plane.halves = View<uint16_t>(static_cast<uint16_t*>(target.pixels), w, h);
      else if (target.type == PixelType::uint)
        plane.words = View<uint32_t>(static_cast<uint32_t*>(target.pixels), w, h);
      else
        plane.values = View<float>(static_cast<float*>(target.pixels), w, h);
      planes.push_back(plane);
    }
    file.read(planes);
  }

 private:
  bool isSame(const PictureHeader& header) const {
    return header.dataWindow == window_ &&
           std::equal(header.channels.begin(), header.channels.end(), channels_.begin(),
                      channels_.end(), [](const PictureChannel& a, const PictureChannel& b) {
                        return a.name == b.name && a.type == b.type;
                      });
  }
  int placeOf(const std::string& name) const {
    const auto found = std::find_if(channels_.begin(), channels_.end(),
                                    [&](const PictureChannel& c) { return c.name == name; });
    return static_cast<int>(found - channels_.begin());
  }

  std::filesystem::path path_;
  Window window_;
  std::vector<PictureChannel> channels_;
};

Imath::Box2i boxOf(const Window& w) {
  return {Imath::V2i(w.x, w.y), Imath::V2i(w.x + w.width - 1, w.y + w.height - 1)};
}

Imf::Header headerOf(const PictureHeader& picture) {
  Imf::Header header(boxOf(picture.displayWindow), boxOf(picture.dataWindow));
  for (const PictureAttribute& attribute : picture.attributes) {
    const bool ours = attribute.type == "string" && !attribute.text.empty() &&
                      !isFromImage(attribute.name) && !isOfStorage(attribute.name) &&
                      attribute.name.find("ICC") == std::string::npos;
    if (ours) header.insert(attribute.name, Imf::StringAttribute(attribute.text));
  }
  return header;
}

ImageFile openOther(const std::filesystem::path& path) {
  const PictureHeader header = PictureFile(path).header();
  if (header.orientation != 1)
    throw InputError(
        fmt::format("{} is stored turned (Orientation {}), and a frame is not; turn "
                    "it upright first (oiiotool --autoorient)",
                    path.string(), header.orientation));
  ImageFile file;
  file.path = path;
  Part part;
  part.dataWindow = header.dataWindow;
  part.compression = header.format == "jpeg" || header.format == "webp" ? header.format : "none";
  part.file = path;
  part.source = std::make_shared<PictureSource>(path, header);
  part.ofIntegers = isInteger(header.channels.front().type);
  part.straight = header.unassociated;
  file.parts = {std::move(part)};
  for (const PictureChannel& channel : header.channels)
    file.channels.push_back({channel.name, channel.name, typeOf(channel.type), 0});
  file.headers = std::make_shared<std::vector<Imf::Header>>(1, headerOf(header));
  file.ownParts = {0};
  describeOwnParts(file);
  return file;
}

}  // namespace

ImageFile openAnyImage(const std::filesystem::path& path) {
  return startsAsExr(path) ? openImage(path) : openOther(path);
}

}  // namespace kagefude
