#include "oiio/read_picture.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>

#include "oiio/webp_file.h"

namespace kagefude::oiio {
namespace {

/// Longer attributes are thumbnails, profiles and maker's notes, which nobody asks for here.
constexpr size_t longestList = 64, longestText = 1 << 16;

SampleType typeOf(OIIO::TypeDesc type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::HALF:
      return SampleType::half;
    case OIIO::TypeDesc::FLOAT:
    case OIIO::TypeDesc::DOUBLE:
      return SampleType::single;
    case OIIO::TypeDesc::UINT8:
    case OIIO::TypeDesc::INT8:
      return SampleType::uint8;
    case OIIO::TypeDesc::UINT16:
    case OIIO::TypeDesc::INT16:
      return SampleType::uint16;
    default:
      return SampleType::uint32;
  }
}

PictureAttribute describe(const OIIO::ParamValue& value) {
  PictureAttribute attribute{value.name().string(), value.type().c_str(), "", {}};
  const OIIO::TypeDesc::BASETYPE base =
      static_cast<OIIO::TypeDesc::BASETYPE>(value.type().basetype);
  attribute.text = value.type() == OIIO::TypeString ? std::string(value.get_ustring().string())
                                                    : value.get_string(64);
  if (base == OIIO::TypeDesc::STRING || value.type().size() > longestList * 8) return attribute;
  const int count = static_cast<int>(value.type().basevalues()) * value.nvalues();
  for (int i = 0; i < count; ++i)
    attribute.numbers.push_back(value.type().is_floating_point()
                                    ? double{value.get_float_indexed(i)}
                                    : double(value.get_int_indexed(i)));
  return attribute;
}

/// Formats whose colours are not multiplied by alpha though OpenImageIO 2.4 does not say so: by
/// their definitions (BMP, ICO, DDS of DXT 1, 3 and 5), and where it hands them out that way when
/// it is asked not to multiply (JPEG 2000, Photoshop). 3.1 does not multiply a WebP's, and says so
/// from 3.1.10 on; before 3.1 it is multiplied whatever is asked.
bool isStraight(const std::string& format) {
  const int version = OIIO::openimageio_version();
  if (format == "webp") return version >= 30100;
  for (const char* name : {"bmp", "ico", "dds", "jpeg2000", "psd"})
    if (format == name) return true;
  return false;
}

PictureHeader describe(const OIIO::ImageSpec& spec, const std::string& format) {
  PictureHeader header;
  header.format = format;
  header.dataWindow = {spec.x, spec.y, spec.width, spec.height};
  header.displayWindow = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  header.depth = spec.depth;
  header.deep = spec.deep;
  // GIF's reader counts it from 1.
  header.alpha = std::min(spec.alpha_channel, spec.nchannels - 1);
  header.unassociated = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0 || isStraight(format);
  header.colourSpace = spec.get_string_attribute("oiio:ColorSpace");
  header.orientation = spec.get_int_attribute("Orientation", 1);
  for (int c = 0; c < spec.nchannels; ++c)
    header.channels.push_back({spec.channel_name(c), typeOf(spec.channelformat(c))});
  for (const OIIO::ParamValue& value : spec.extra_attribs)
    if (value.type().size() * static_cast<size_t>(value.nvalues()) <= longestText)
      header.attributes.push_back(describe(value));
  return header;
}

/// OpenImageIO makes RGB of a Photoshop file's inks without saying so; its header says it.
void addInks(const std::string& path, PictureHeader& header) {
  if (header.format != "psd") return;
  constexpr size_t modeAt = 25;
  constexpr char cmyk = 4;
  std::array<char, modeAt + 1> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  if (start[modeAt] == cmyk) header.attributes.push_back({"psd:ColorMode", "string", "CMYK", {}});
}

[[noreturn]] void fail(const std::string& words) {
  throw std::runtime_error(words.empty() ? "it is damaged" : words);
}

template <class From, class To>
void widen(const std::byte* from, size_t step, size_t pixels, std::byte* to) {
  auto* const out = reinterpret_cast<To*>(to);
  const auto* in = reinterpret_cast<const From*>(from);
  for (size_t i = 0; i < pixels; ++i, in += step) out[i] = static_cast<To>(*in);
}

/// The type that OpenImageIO is asked for: the file's own for whole numbers, which it would scale.
OIIO::TypeDesc askedType(const OIIO::ImageSpec& spec, const WantedPlane& plane) {
  if (plane.type == PlaneType::half) return OIIO::TypeHalf;
  return plane.type == PlaneType::single ? OIIO::TypeFloat : spec.channelformat(plane.channel);
}

/// A channel out of `count` that lie beside each other in `pixels`.
void takeChannel(const std::byte* pixels, OIIO::TypeDesc type, size_t count, size_t place,
                 size_t number, const WantedPlane& plane, std::byte* out) {
  const std::byte* const first = pixels + place * type.size();
  if (plane.type == PlaneType::half) return widen<uint16_t, uint16_t>(first, count, number, out);
  if (plane.type == PlaneType::single) return widen<float, float>(first, count, number, out);
  switch (typeOf(type)) {
    case SampleType::uint8:
      return widen<uint8_t, uint32_t>(first, count, number, out);
    case SampleType::uint16:
    case SampleType::half:
      return widen<uint16_t, uint32_t>(first, count, number, out);
    default:
      return widen<uint32_t, uint32_t>(first, count, number, out);
  }
}

bool follows(const WantedPlane& a, const WantedPlane& b) { return b.channel == a.channel + 1; }

}  // namespace

OpenedPicture openPicture(const std::string& path) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // colours as the file has them
  OpenedPicture picture;
  picture.input = OIIO::ImageInput::open(path, &config);
  if (!picture.input) fail(OIIO::geterror());
  OIIO::ImageSpec spec = picture.input->spec();
  const std::string format = picture.input->format_name();
  if (format == "webp") addWebpMetadata(path, spec);
  picture.header = describe(spec, format);
  addInks(path, picture.header);
  picture.header.severalPictures = picture.input->seek_subimage(1, 0);
  (void)picture.input->geterror();
  if (!picture.input->seek_subimage(0, 0)) fail(picture.input->geterror());
  return picture;
}

void readPlanes(OpenedPicture& picture, const std::vector<WantedPlane>& wanted, std::byte* planes) {
  const OIIO::ImageSpec spec = picture.input->spec(0, 0);
  const auto pixels = static_cast<size_t>(spec.image_pixels());
  // Neighbouring channels of one type are decoded together.
  for (size_t first = 0, end; first < wanted.size(); first = end) {
    const OIIO::TypeDesc type = askedType(spec, wanted[first]);
    for (end = first + 1; end < wanted.size() && follows(wanted[end - 1], wanted[end]) &&
                          askedType(spec, wanted[end]) == type;)
      ++end;
    const size_t count = end - first;
    std::vector<std::byte> interleaved(pixels * count * type.size());
    if (!picture.input->read_image(0, 0, wanted[first].channel,
                                   wanted[first].channel + static_cast<int>(count), type,
                                   interleaved.data()))
      fail(picture.input->geterror());
    for (size_t i = 0; i < count; ++i)
      takeChannel(interleaved.data(), type, count, i, pixels, wanted[first + i],
                  planes + wanted[first + i].offset);
  }
}

}  // namespace kagefude::oiio
