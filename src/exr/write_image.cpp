#include "exr/write_image.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "exr/attributes.h"
#include "exr/carry_attributes.h"
#include "exr/fast_write.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

class Stream : public Imf::OStream {
 public:
  explicit Stream(AtomicFile& file) : Imf::OStream(file.finalPath().c_str()), file_(file) {}
  void write(const char bytes[], int count) override {
    file_.write(bytes, static_cast<size_t>(count));
  }
  uint64_t tellp() override { return file_.position(); }
  void seekp(uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
};

Imath::Box2i openExrBox(const Window& w) {
  return {Imath::V2i(w.x, w.y), Imath::V2i(w.x + w.width - 1, w.y + w.height - 1)};
}

Imf::PixelType fileType(PixelType type) {
  if (type == PixelType::half) return Imf::HALF;
  return type == PixelType::uint ? Imf::UINT : Imf::FLOAT;
}

/// The nearest half, but a number beyond a half's range is held at the largest instead of becoming
/// infinite.
uint16_t heldHalf(float value) {
  constexpr float largest = 65504.0f;
  if (value > largest && value <= 3.4028235e38f) value = largest;
  if (value < -largest && value >= -3.4028235e38f) value = -largest;
  return imath_float_to_half(value);
}

Plane<uint16_t> toHalf(View<const float> values) {
  Plane<uint16_t> halves(values.width, values.height);
  parallelRows(values.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < values.width; ++x) halves(x, y) = heldHalf(values(x, y));
    }
  });
  return halves;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const OutputChannel& channel,
                         std::string_view why) {
  throw OutputError(
      fmt::format("{} cannot be written: channel {} {}", path.string(), channel.name, why));
}

void check(const std::filesystem::path& path, const OutputImage& image) {
  if (image.channels.empty()) throw OutputError(path.string() + " would have no channels");
  std::set<std::string_view> names;
  for (const OutputChannel& c : image.channels) {
    const int filled = !c.values.empty() + !c.halves.empty() + !c.words.empty();
    if (c.name.empty() || filled != 1) refuse(path, c, "has no name or not exactly one plane");
    if (!names.insert(c.name).second) refuse(path, c, "is given twice");
    if ((c.type == PixelType::half && !c.words.empty()) ||
        (c.type != PixelType::half && !c.halves.empty()) ||
        (c.type == PixelType::uint && !c.values.empty())) {
      refuse(path, c, "has a plane of another type");
    }
    const int width = std::max({c.values.width, c.halves.width, c.words.width});
    const int height = std::max({c.values.height, c.halves.height, c.words.height});
    if (width != image.dataWindow.width || height != image.dataWindow.height) {
      refuse(path, c,
             fmt::format("is {} x {} pixels in a data window of {} x {}", width, height,
                         image.dataWindow.width, image.dataWindow.height));
    }
  }
}

// The planes as they are stored; `made` owns the half planes that had to be made.
Imf::FrameBuffer frameBufferOf(const OutputImage& image, std::vector<Plane<uint16_t>>& made) {
  Imf::FrameBuffer buffer;
  const Window& w = image.dataWindow;
  for (const OutputChannel& c : image.channels) {
    const void* pixels = c.words.data;
    if (c.type == PixelType::half && !c.values.empty()) {
      made.push_back(toHalf(c.values));
      pixels = made.back().row(0);
    } else if (!c.values.empty()) {
      pixels = c.values.data;
    } else if (!c.halves.empty()) {
      pixels = c.halves.data;
    }
    const size_t bytes = c.type == PixelType::half ? 2 : 4;
    buffer.insert(c.name, Imf::Slice::Make(fileType(c.type), pixels, Imath::V2i(w.x, w.y), w.width,
                                           w.height, bytes, bytes * static_cast<size_t>(w.width)));
  }
  return buffer;
}

}  // namespace

OutputChannel floatChannel(std::string name, PixelType type, View<const float> values) {
  return {std::move(name), type, values, {}, {}};
}

OutputChannel labelChannel(std::string name, View<const uint32_t> labels) {
  return {std::move(name), PixelType::uint, {}, {}, labels};
}

OutputChannel rawChannel(const RawPlane& plane, std::string name) {
  if (name.empty()) name = plane.name;
  if (plane.type == PixelType::half) return {std::move(name), plane.type, {}, plane.halves, {}};
  return {std::move(name), plane.type, {}, {}, plane.words};
}

Imf::Header makeHeader(const OutputImage& image) {
  constexpr std::array<Imf::Compression, 5> codecs = {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION,
                                                      Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
                                                      Imf::PIZ_COMPRESSION};
  Imf::Header header(openExrBox(image.displayWindow), openExrBox(image.dataWindow),
                     image.pixelAspect);
  header.compression() = codecs[static_cast<size_t>(image.compression)];
  if (image.source) detail::carryAttributes(*image.source, image.allParts, header);
  for (const auto& [name, value] : image.attributes) {
    header.erase(name);
    header.insert(name, Imf::StringAttribute(value));
  }
  for (const OutputChannel& c : image.channels) {
    header.channels().insert(c.name, Imf::Channel(fileType(c.type)));
  }
  return header;
}

namespace {

ExrSourceChannel fastChannel(const OutputChannel& c) {
  constexpr std::array<ExrType, 3> types = {ExrType::half, ExrType::float32, ExrType::uint32};
  const ExrType type = types[static_cast<size_t>(c.type)];
  if (!c.halves.empty()) return {c.name, type, c.halves};
  if (!c.words.empty()) return {c.name, type, c.words};
  return {c.name, type, c.values};
}

// The image in the fast writer's terms; nothing for codecs and attributes that it does not know.
// `made` owns the half planes: values beyond a half's range are held there, so they are made here.
std::optional<ExrImage> fastImage(const OutputImage& image, const Imf::Header& header,
                                  std::vector<Plane<uint16_t>>& made) {
  if (image.compression == Compression::rle || image.compression == Compression::piz) {
    return std::nullopt;
  }
  auto attributes = detail::fastAttributes(header);
  if (!attributes) return std::nullopt;
  ExrImage fast;
  fast.data = image.dataWindow;
  fast.display = image.displayWindow;
  fast.pixelAspect = image.pixelAspect;
  fast.screenWindowCenter = {header.screenWindowCenter().x, header.screenWindowCenter().y};
  fast.screenWindowWidth = header.screenWindowWidth();
  fast.attributes = *std::move(attributes);
  fast.compression = image.compression == Compression::none   ? ExrCompression::none
                     : image.compression == Compression::zips ? ExrCompression::zips
                                                              : ExrCompression::zip;
  for (OutputChannel channel : image.channels) {
    if (channel.type == PixelType::half && !channel.values.empty()) {
      made.push_back(toHalf(channel.values));
      channel.halves = made.back();
    }
    fast.channels.push_back(fastChannel(channel));
  }
  return fast;
}

// Messages name the file that the caller asked for, not its temporary.
void writeFast(const AtomicFile& file, const ExrImage& image) {
  try {
    writeFastExr(file.temporaryPath(), image);
  } catch (const OutputError& problem) {
    std::string message = problem.what();
    const std::string temporary = file.temporaryPath().string();
    const size_t place = message.find(temporary);
    if (place != std::string::npos) {
      message.replace(place, temporary.size(), file.finalPath().string());
    }
    throw OutputError(message);
  }
}

void writeByOpenExr(AtomicFile& file, const OutputImage& image, const Imf::Header& header) {
  std::vector<Plane<uint16_t>> made;
  const Imf::FrameBuffer buffer = frameBufferOf(image, made);
  Stream stream(file);
  Imf::OutputFile output(stream, header, 0);
  output.setFrameBuffer(buffer);
  output.writePixels(image.dataWindow.height);
}

}  // namespace

void writeExr(const std::filesystem::path& path, const OutputImage& image) {
  check(path, image);
  AtomicFile file(path);
  try {
    const Imf::Header header = makeHeader(image);
    std::vector<Plane<uint16_t>> made;
    if (const auto fast = fastImage(image, header, made)) {
      writeFast(file, *fast);
    } else {
      writeByOpenExr(file, image, header);
    }
  } catch (const OutputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    throw OutputError(fmt::format("{} cannot be written: {}", path.string(), problem.what()));
  }
  // OpenEXR writes its chunk table when the output ends and swallows errors there; the file
  // remembers them and refuses to commit.
  file.commit();
}

}  // namespace kagefude
