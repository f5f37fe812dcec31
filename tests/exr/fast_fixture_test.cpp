#include "exr/fast_fixture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenImageIO/imageio.h>

#include <random>

namespace kagefude {
namespace {

Imath::Box2i boxOf(const Window& w) {
  return {{w.x, w.y}, {w.x + w.width - 1, w.y + w.height - 1}};
}

Imf::PixelType pixelType(ExrType type) {
  return type == ExrType::half ? Imf::HALF : type == ExrType::uint32 ? Imf::UINT : Imf::FLOAT;
}

template <class T>
void append(std::vector<uint8_t>& bytes, T value) {
  const auto* p = reinterpret_cast<const uint8_t*>(&value);
  bytes.insert(bytes.end(), p, p + sizeof value);
}

TestChannel makeChannel(const std::string& name, ExrType type, Window data, TestPixels pixels,
                        std::mt19937& generator) {
  TestChannel channel{name, type, {}};
  const float start = static_cast<float>(generator() % 100);
  for (int64_t i = 0; i < data.pixels(); ++i) {
    const uint32_t any = generator();
    const float smooth = start + static_cast<float>(i) * 0.25f;
    const float value = pixels == TestPixels::flat ? start : smooth;
    if (type == ExrType::uint32) {
      append(channel.bytes, pixels == TestPixels::noise ? any : static_cast<uint32_t>(value));
    } else if (type == ExrType::half) {
      const auto bits = static_cast<uint16_t>(any & 0xfbffu);  // never infinity or NaN
      append(channel.bytes, pixels == TestPixels::noise ? bits : Imath::half(value).bits());
    } else if (pixels == TestPixels::noise) {
      append(channel.bytes, any & 0xff7fffffu);
    } else {
      append(channel.bytes, value);
    }
  }
  return channel;
}

Imf::Header headerOf(const TestPart& part, bool multi) {
  Imf::Header header(boxOf(part.display), boxOf(part.data));
  header.compression() = part.compression;
  header.lineOrder() = part.order;
  if (multi) {
    header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
  }
  for (const TestChannel& c : part.channels) {
    header.channels().insert(c.name, Imf::Channel(pixelType(c.type)));
  }
  return header;
}

Imf::FrameBuffer frameBufferOf(const TestPart& part) {
  Imf::FrameBuffer frame;
  for (const TestChannel& c : part.channels) {
    const auto size = static_cast<size_t>(exrTypeBytes(c.type));
    frame.insert(c.name, Imf::Slice::Make(pixelType(c.type), c.bytes.data(), boxOf(part.data), size,
                                          size * static_cast<size_t>(part.data.width)));
  }
  return frame;
}

}  // namespace

TestPart makeTestPart(const std::string& name, Window data, Imf::Compression compression,
                      TestPixels pixels, uint32_t seed) {
  std::mt19937 generator(seed);
  TestPart part;
  part.name = name;
  part.data = data;
  part.display = {0, 0, 64, 48};
  part.compression = compression;
  part.channels = {
      makeChannel("R", ExrType::half, data, pixels, generator),
      makeChannel("Layer.Depth.Z", ExrType::float32, data, pixels, generator),
      makeChannel("Layer.Index.X", ExrType::uint32, data, pixels, generator),
      makeChannel("A", ExrType::half, data, pixels, generator),
      makeChannel("Layer.Position.X", ExrType::float32, data, pixels, generator),
  };
  return part;
}

void writeWithOpenExr(const std::string& path, const std::vector<TestPart>& parts) {
  if (parts.size() == 1) {
    Imf::OutputFile out(path.c_str(), headerOf(parts[0], false));
    out.setFrameBuffer(frameBufferOf(parts[0]));
    if (parts[0].data.height > 0) out.writePixels(parts[0].data.height);
    return;
  }
  std::vector<Imf::Header> headers;
  for (const TestPart& part : parts) headers.push_back(headerOf(part, true));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (size_t i = 0; i < parts.size(); ++i) {
    Imf::OutputPart out(file, static_cast<int>(i));
    out.setFrameBuffer(frameBufferOf(parts[i]));
    out.writePixels(parts[i].data.height);
  }
}

std::vector<uint8_t> readWithOiio(const std::string& path, int part, const std::string& channel,
                                  ExrType type) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) throw std::runtime_error(OIIO::geterror());
  const OIIO::ImageSpec spec = input->spec(part);
  const int index = spec.channelindex(channel);
  if (index < 0) throw std::runtime_error("OIIO finds no channel " + channel);
  const bool uint = type == ExrType::uint32;
  std::vector<uint8_t> bytes(spec.image_pixels() * 4);
  if (!input->read_image(part, 0, index, index + 1, uint ? OIIO::TypeUInt32 : OIIO::TypeFloat,
                         bytes.data())) {
    throw std::runtime_error(input->geterror());
  }
  return bytes;
}

}  // namespace kagefude
