#include "exr/fast_header.h"

#include <OpenEXR/openexr.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "base/error.h"
#include "exr/reserved_attributes.h"

namespace kagefude {
namespace {

constexpr size_t longestShortName = 31;
constexpr size_t longestName = 255;

/// Sets one attribute; a value's type picks the EXR type.
struct SetAttribute {
  exr_context_t context;
  const char* name;

  exr_result_t operator()(int32_t v) const { return exr_attr_set_int(context, 0, name, v); }
  exr_result_t operator()(float v) const { return exr_attr_set_float(context, 0, name, v); }
  exr_result_t operator()(double v) const { return exr_attr_set_double(context, 0, name, v); }
  exr_result_t operator()(const std::string& v) const {
    return exr_attr_set_string(context, 0, name, v.c_str());
  }
  exr_result_t operator()(const std::array<int32_t, 2>& v) const {
    const exr_attr_v2i_t value{v[0], v[1]};
    return exr_attr_set_v2i(context, 0, name, &value);
  }
  exr_result_t operator()(const std::array<int32_t, 3>& v) const {
    const exr_attr_v3i_t value{v[0], v[1], v[2]};
    return exr_attr_set_v3i(context, 0, name, &value);
  }
  exr_result_t operator()(const std::array<float, 2>& v) const {
    const exr_attr_v2f_t value{v[0], v[1]};
    return exr_attr_set_v2f(context, 0, name, &value);
  }
  exr_result_t operator()(const std::array<float, 3>& v) const {
    const exr_attr_v3f_t value{v[0], v[1], v[2]};
    return exr_attr_set_v3f(context, 0, name, &value);
  }
  exr_result_t operator()(const std::array<float, 8>& v) const {
    const exr_attr_chromaticities_t value = {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
    return exr_attr_set_chromaticities(context, 0, name, &value);
  }
  exr_result_t operator()(const std::array<float, 9>& v) const {
    exr_attr_m33f_t value;
    std::copy(v.begin(), v.end(), value.m);
    return exr_attr_set_m33f(context, 0, name, &value);
  }
  exr_result_t operator()(const std::array<float, 16>& v) const {
    exr_attr_m44f_t value;
    std::copy(v.begin(), v.end(), value.m);
    return exr_attr_set_m44f(context, 0, name, &value);
  }
  exr_result_t operator()(const std::vector<std::string>& v) const {
    std::vector<const char*> strings;
    for (const std::string& s : v) strings.push_back(s.c_str());
    return exr_attr_set_string_vector(context, 0, name, static_cast<int32_t>(strings.size()),
                                      strings.data());
  }
  exr_result_t operator()(const std::vector<float>& v) const {
    return exr_attr_set_float_vector(context, 0, name, static_cast<int32_t>(v.size()), v.data());
  }
  exr_result_t operator()(const ExrRational& v) const {
    const exr_attr_rational_t value = {v.numerator, v.denominator};
    return exr_attr_set_rational(context, 0, name, &value);
  }
  exr_result_t operator()(const ExrTimeCode& v) const {
    const exr_attr_timecode_t value = {v.timeAndFlags, v.userData};
    return exr_attr_set_timecode(context, 0, name, &value);
  }
};

exr_attr_box2i_t attributeBox(const Window& window) {
  exr_attr_box2i_t box;
  box.min.x = window.x;
  box.min.y = window.y;
  box.max.x = window.x + (window.width - 1);
  box.max.y = window.y + (window.height - 1);
  return box;
}

exr_pixel_type_t pixelType(ExrType type) {
  switch (type) {
    case ExrType::uint32:
      return EXR_PIXEL_UINT;
    case ExrType::half:
      return EXR_PIXEL_HALF;
    default:
      return EXR_PIXEL_FLOAT;
  }
}

exr_compression_t compressionOf(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::zips:
      return EXR_COMPRESSION_ZIPS;
    case ExrCompression::zip:
      return EXR_COMPRESSION_ZIP;
    default:
      return EXR_COMPRESSION_NONE;
  }
}

/// OpenEXR refuses windows that reach beyond half the range of an int.
bool windowIsUsable(const Window& w) {
  constexpr int64_t limit = INT32_MAX / 2;
  const auto inside = [](int64_t first, int64_t size) {
    return size > 0 && first >= -limit && first + size - 1 < limit;
  };
  return inside(w.x, w.width) && inside(w.y, w.height);
}

void checkName(const std::string& path, const char* kind, const std::string& name,
               std::set<std::string>& seen) {
  if (name.empty() || name.size() > longestName || name.find('\0') != std::string::npos) {
    throw OutputError(fmt::format("{}: '{}' cannot be the name of {}; it must have 1 to {} bytes",
                                  path, name, kind, longestName));
  }
  if (!seen.insert(name).second) {
    throw OutputError(fmt::format("{}: there are two {}s named '{}'", path, kind, name));
  }
}

void checkChannel(const std::string& path, const ExrImage& image, const ExrSourceChannel& channel) {
  const bool sizeFits = std::visit(
      [&](const auto& v) {
        return v.data != nullptr && v.width == image.data.width && v.height == image.data.height;
      },
      channel.pixels);
  const bool half = channel.type == ExrType::half;
  const bool typeFits = std::holds_alternative<View<const float>>(channel.pixels)
                            ? channel.type != ExrType::uint32
                            : std::holds_alternative<View<const uint16_t>>(channel.pixels) == half;
  if (!sizeFits || !typeFits) {
    throw OutputError(fmt::format("{}: the plane of channel {} has the wrong {}", path,
                                  channel.name, sizeFits ? "type" : "size"));
  }
}

bool hasLongName(const ExrImage& image) {
  const auto isLong = [](const auto& named) { return named.name.size() > longestShortName; };
  return std::any_of(image.channels.begin(), image.channels.end(), isLong) ||
         std::any_of(image.attributes.begin(), image.attributes.end(), isLong);
}

void require(exr_result_t result, const std::string& path, std::string_view what) {
  if (result == EXR_ERR_SUCCESS) return;
  throw OutputError(
      fmt::format("{}: cannot write {}: {}", path, what, exr_get_default_error_message(result)));
}

}  // namespace

void checkExrImage(const std::string& path, const ExrImage& image) {
  if (!windowIsUsable(image.data) || !windowIsUsable(image.display)) {
    throw OutputError(fmt::format(
        "{}: an image of {} x {} pixels in a display of {} x {} cannot "
        "be written",
        path, image.data.width, image.data.height, image.display.width, image.display.height));
  }
  if (image.channels.empty()) throw OutputError(fmt::format("{}: there are no channels", path));
  if (image.compression == ExrCompression::rle) {
    throw OutputError(fmt::format("{}: rle is read, not written; take zip, zips or none", path));
  }
  int64_t chunkBytes = 0;
  std::set<std::string> channels;
  for (const ExrSourceChannel& channel : image.channels) {
    checkName(path, "channel", channel.name, channels);
    checkChannel(path, image, channel);
    chunkBytes += static_cast<int64_t>(image.data.width) * exrTypeBytes(channel.type) *
                  exrRowsPerChunk(image.compression);
  }
  if (chunkBytes > INT32_MAX) {
    throw OutputError(
        fmt::format("{}: {} channels of {} pixels a row are more than an EXR chunk "
                    "can hold",
                    path, image.channels.size(), image.data.width));
  }
  std::set<std::string> attributes;
  for (const ReservedAttribute& reserved : reservedAttributes)
    if (reserved.fromImage) attributes.emplace(reserved.name);
  for (const ExrAttribute& attribute : image.attributes) {
    checkName(path, "attribute", attribute.name, attributes);
  }
}

void writeExrHeader(const std::string& path, _priv_exr_context_t* context, const ExrImage& image) {
  // Older readers refuse files with the long-name flag, so it is set only where it is needed.
  if (hasLongName(image)) require(exr_set_longname_support(context, 1), path, "long names");
  int part = 0;
  require(exr_add_part(context, nullptr, EXR_STORAGE_SCANLINE, &part), path, "the header");
  const exr_attr_box2i_t data = attributeBox(image.data);
  const exr_attr_box2i_t display = attributeBox(image.display);
  const exr_attr_v2f_t center{image.screenWindowCenter[0], image.screenWindowCenter[1]};
  require(exr_initialize_required_attr(context, part, &display, &data, image.pixelAspect, &center,
                                       image.screenWindowWidth, EXR_LINEORDER_INCREASING_Y,
                                       compressionOf(image.compression)),
          path, "the header");
  for (const ExrSourceChannel& channel : image.channels) {
    require(exr_add_channel(context, part, channel.name.c_str(), pixelType(channel.type),
                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1),
            path, "channel " + channel.name);
  }
  for (const ExrAttribute& attribute : image.attributes) {
    require(std::visit(SetAttribute{context, attribute.name.c_str()}, attribute.value), path,
            "attribute " + attribute.name);
  }
  require(exr_write_header(context), path, "the header");
}

}  // namespace kagefude
