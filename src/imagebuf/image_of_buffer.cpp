#include "imagebuf/image_of_buffer.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include "base/error.h"
#include "exr/read_channels.h"
#include "exr/reserved_attributes.h"

namespace kagefude {
namespace {

std::string nameOf(const OIIO::ImageBuf& buffer) {
  return buffer.name().empty() ? "the image buffer" : std::string(buffer.name());
}

PixelType typeOf(const OIIO::ImageBuf& buffer) {
  const OIIO::TypeDesc type = buffer.pixeltype();
  if (type == OIIO::TypeHalf) return PixelType::half;
  if (type == OIIO::TypeFloat) return PixelType::single;
  if (type == OIIO::TypeDesc::UINT32) return PixelType::uint;
  throw InputError(fmt::format("{} has pixels of {}; those of a frame are half, float or uint32",
                               nameOf(buffer), type.c_str()));
}

OIIO::TypeDesc typeOf(PixelType type) {
  if (type == PixelType::half) return OIIO::TypeHalf;
  return type == PixelType::single ? OIIO::TypeFloat : OIIO::TypeUInt32;
}

class BufferSource : public PlaneSource {
 public:
  explicit BufferSource(const OIIO::ImageBuf& buffer) : buffer_(buffer) {}

  void read(std::span<const PlaneTarget> targets) const override {
    for (const PlaneTarget& target : targets) {
      OIIO::ROI roi = buffer_.roi();
      roi.chbegin = buffer_.spec().channelindex(target.channel->nameInPart);
      roi.chend = roi.chbegin + 1;
      if (!buffer_.get_pixels(roi, typeOf(target.type), target.pixels))
        throw InputError(fmt::format("{} cannot be read: {}", nameOf(buffer_), buffer_.geterror()));
      // OpenImageIO takes integers for parts of one, and these are numbers.
      if (target.channel->type == PixelType::uint && target.type == PixelType::single)
        for (size_t i = 0; i < buffer_.spec().image_pixels(); ++i)
          static_cast<float*>(target.pixels)[i] *= 4294967295.0f;
    }
  }

 private:
  const OIIO::ImageBuf& buffer_;
};

Imath::Box2i boxOf(const Window& w) {
  return {Imath::V2i(w.x, w.y), Imath::V2i(w.x + w.width - 1, w.y + w.height - 1)};
}

Imf::Header headerOf(const OIIO::ImageSpec& spec, const Window& data, const Window& display) {
  Imf::Header header(boxOf(display), boxOf(data));
  header.pixelAspectRatio() = spec.get_float_attribute("PixelAspectRatio", 1.0f);
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    const std::string name = value.name().string();
    const bool text = value.type() == OIIO::TypeString && value.nvalues() == 1;
    if (text && !isFromImage(name) && !isOfStorage(name))
      header.insert(name, Imf::StringAttribute(value.get_ustring().string()));
  }
  return header;
}

}  // namespace

ImageFile imageOfBuffer(const OIIO::ImageBuf& buffer) {
  const OIIO::ImageSpec& spec = buffer.spec();
  if (!buffer.initialized() || spec.image_pixels() == 0 || spec.nchannels == 0)
    throw InputError(fmt::format("{} is empty {}", nameOf(buffer), buffer.geterror()));
  if (buffer.deep() || spec.depth > 1)
    throw InputError(fmt::format("{} is deep or a volume; flatten it first", nameOf(buffer)));
  ImageFile file;
  file.path = nameOf(buffer);
  Part part;
  part.dataWindow = {spec.x, spec.y, spec.width, spec.height};
  part.compression = "none";
  part.file = file.path;
  part.source = std::make_shared<BufferSource>(buffer);
  const PixelType type = typeOf(buffer);
  for (const std::string& name : spec.channelnames) file.channels.push_back({name, name, type, 0});
  const Window display{spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  file.headers =
      std::make_shared<std::vector<Imf::Header>>(1, headerOf(spec, part.dataWindow, display));
  file.parts = {std::move(part)};
  file.ownParts = {0};
  describeOwnParts(file);
  return file;
}

}  // namespace kagefude
