#include "exr/fast_read.h"

#include <Imath/half.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "exr/fast_fixture.h"

namespace kagefude {
namespace {

class ExrFastRead : public ExrFastTest {};

template <class T>
std::vector<uint8_t> bytesOf(const Plane<T>& plane) {
  const auto* p = reinterpret_cast<const uint8_t*>(plane.row(0));
  return {p, p + plane.view().pixels() * sizeof(T)};
}

/// Reads every channel of every part in all ways that its type allows, and compares.
void expectSamePixels(const std::string& path, const std::vector<TestPart>& parts) {
  const auto file = FastExr::open(path);
  ASSERT_TRUE(file);
  ASSERT_EQ(file->parts().size(), parts.size());
  for (size_t p = 0; p < parts.size(); ++p) {
    const ExrPart& header = file->parts()[p];
    ASSERT_TRUE(header.readable);
    EXPECT_EQ(header.data, parts[p].data);
    EXPECT_EQ(header.display, parts[p].display);
    ASSERT_EQ(header.channels.size(), parts[p].channels.size());
    for (const TestChannel& channel : parts[p].channels) {
      SCOPED_TRACE(channel.name);
      const int index = header.channelIndex(channel.name);
      ASSERT_GE(index, 0);
      const int part = static_cast<int>(p);
      const auto oiio = readWithOiio(path, part, channel.name, channel.type);
      if (channel.type == ExrType::half) {
        Plane<uint16_t> bits(header.data.width, header.data.height);
        Floats floats(header.data.width, header.data.height);
        const ExrTarget targets[] = {{index, floats.view()}, {index, bits.view()}};
        file->read(part, targets);
        EXPECT_EQ(bytesOf(bits), channel.bytes);
        EXPECT_EQ(bytesOf(floats), oiio);
      } else {
        Labels bits(header.data.width, header.data.height);
        const ExrTarget targets[] = {{index, bits.view()}};
        file->read(part, targets);
        EXPECT_EQ(bytesOf(bits), channel.bytes);
        EXPECT_EQ(bytesOf(bits), oiio);
      }
    }
  }
}

const Imf::Compression codecs[] = {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                   Imf::ZIP_COMPRESSION};
const Window windows[] = {{0, 0, 64, 48},  {-7, -20, 33, 47}, {5, 9, 1, 1},
                          {0, 0, 131, 16}, {-3, 40, 70, 17},  {1000000000, -1000000000, 3, 5}};

TEST_F(ExrFastRead, SamePixelsAsOiioOverCodecsWindowsAndContents) {
  for (const Imf::Compression codec : codecs) {
    for (const Window& window : windows) {
      for (const TestPixels pixels : {TestPixels::smooth, TestPixels::flat, TestPixels::noise}) {
        SCOPED_TRACE(::testing::Message() << codec << " " << window.width << "x" << window.height
                                          << " " << static_cast<int>(pixels));
        const TestPart part = makeTestPart("", window, codec, pixels, 11);
        writeWithOpenExr(file("a.exr"), {part});
        expectSamePixels(file("a.exr"), {part});
      }
    }
  }
}

TEST_F(ExrFastRead, PartsMayDifferInWindowAndCodec) {
  std::vector<TestPart> parts;
  uint32_t seed = 1;
  for (const Imf::Compression codec : codecs) {
    parts.push_back(makeTestPart("part" + std::to_string(seed), windows[seed % 5], codec,
                                 TestPixels::smooth, seed));
    ++seed;
  }
  writeWithOpenExr(file("multi.exr"), parts);
  expectSamePixels(file("multi.exr"), parts);
}

TEST_F(ExrFastRead, HalfAndUintChannelsBecomeFloats) {
  const TestPart part =
      makeTestPart("", {0, 0, 40, 20}, Imf::ZIP_COMPRESSION, TestPixels::noise, 4);
  writeWithOpenExr(file("a.exr"), {part});
  const auto opened = FastExr::open(file("a.exr"));
  ASSERT_TRUE(opened);
  const int wanted[] = {opened->parts()[0].channelIndex("Layer.Index.X"),
                        opened->parts()[0].channelIndex("R")};
  const auto planes = opened->readFloats(0, wanted);
  for (size_t i = 0; i < 800; ++i) {
    uint32_t index;
    uint16_t half;
    std::memcpy(&index, part.channels[2].bytes.data() + 4 * i, 4);
    std::memcpy(&half, part.channels[0].bytes.data() + 2 * i, 2);
    ASSERT_EQ(planes[0].row(0)[i], static_cast<float>(index));
    ASSERT_EQ(planes[1].row(0)[i], imath_half_to_float(half));
  }
}

TEST_F(ExrFastRead, MasksOfAnyTypeEqualTheirFloatsAgainstOneHalf) {
  for (const Imf::Compression codec : codecs) {
    const TestPart part = makeTestPart("", {0, 0, 1531, 20}, codec, TestPixels::noise, 4);
    writeWithOpenExr(file("a.exr"), {part});
    const auto opened = FastExr::open(file("a.exr"));
    ASSERT_TRUE(opened);
    for (int channel = 0; channel < static_cast<int>(part.channels.size()); ++channel) {
      Bytes mask(1531, 20);
      Floats floats(1531, 20);
      size_t unknown = 0, expected = 0;
      const ExrTarget targets[] = {{channel, mask.view(), &unknown}, {channel, floats.view()}};
      opened->read(0, targets);
      for (size_t i = 0; i < 1531 * 20; ++i) {
        const float value = floats.row(0)[i];
        const bool known = std::isfinite(value);
        ASSERT_EQ(mask.row(0)[i], !known || value >= 0.5f ? 1 : 0) << channel << " " << i;
        expected += !known;
      }
      EXPECT_EQ(unknown, expected) << channel;
    }
  }
}

TEST_F(ExrFastRead, LeavesOtherFilesToOiio) {
  const Window window = {0, 0, 20, 20};
  for (const Imf::Compression codec :
       {Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    writeWithOpenExr(file("a.exr"), {makeTestPart("", window, codec, TestPixels::smooth, 1)});
    EXPECT_FALSE(FastExr::open(file("a.exr")));
  }
  TestPart upsideDown = makeTestPart("", window, Imf::ZIP_COMPRESSION, TestPixels::smooth, 1);
  upsideDown.order = Imf::DECREASING_Y;
  writeWithOpenExr(file("a.exr"), {upsideDown});
  EXPECT_FALSE(FastExr::open(file("a.exr")));
  std::ofstream(file("text.exr")) << "not an image";
  EXPECT_FALSE(FastExr::open(file("text.exr")));
  EXPECT_FALSE(FastExr::open(file("missing.exr")));
  EXPECT_FALSE(FastExr::open(file(".")));
}

TEST_F(ExrFastRead, OnePartOfAnotherKindDoesNotHideTheRest) {
  const std::vector<TestPart> parts = {
      makeTestPart("piz", {0, 0, 20, 20}, Imf::PIZ_COMPRESSION, TestPixels::smooth, 1),
      makeTestPart("zip", {0, 0, 20, 20}, Imf::ZIP_COMPRESSION, TestPixels::smooth, 2)};
  writeWithOpenExr(file("a.exr"), parts);
  const auto opened = FastExr::open(file("a.exr"));
  ASSERT_TRUE(opened);
  EXPECT_FALSE(opened->parts()[0].readable);
  EXPECT_EQ(opened->parts()[0].name, "piz");
  EXPECT_TRUE(opened->parts()[1].readable);
  EXPECT_THROW(opened->readFloats(0, std::vector<int>{}), InputError);
  const int wanted[] = {0};
  EXPECT_NO_THROW(opened->readFloats(1, wanted));
}

TEST_F(ExrFastRead, RefusesPlanesThatCannotHoldTheChannel) {
  writeWithOpenExr(file("a.exr"),
                   {makeTestPart("", {0, 0, 20, 20}, Imf::ZIP_COMPRESSION, TestPixels::smooth, 1)});
  const auto opened = FastExr::open(file("a.exr"));
  ASSERT_TRUE(opened);
  const int half = opened->parts()[0].channelIndex("R");
  const int depth = opened->parts()[0].channelIndex("Layer.Depth.Z");
  Floats small(20, 19);
  Labels labels(20, 20);
  Plane<uint16_t> bits(20, 20);
  const auto read = [&](ExrTarget target) { opened->read(0, std::span(&target, 1)); };
  EXPECT_THROW(read({half, small.view()}), InputError);
  EXPECT_THROW(read({half, labels.view()}), InputError);
  EXPECT_THROW(read({depth, bits.view()}), InputError);
  EXPECT_THROW(read({5, labels.view()}), InputError);
  EXPECT_THROW(read({-1, labels.view()}), InputError);
}

TEST_F(ExrFastRead, NamesFileAndTopmostScanlineOfADamagedChunk) {
  const TestPart part =
      makeTestPart("", {-4, -10, 64, 200}, Imf::ZIP_COMPRESSION, TestPixels::smooth, 1);
  writeWithOpenExr(file("a.exr"), {part});
  // Cutting the file off in the middle leaves the upper chunks whole.
  std::filesystem::resize_file(file("a.exr"), std::filesystem::file_size(file("a.exr")) / 2);
  std::string first;
  for (int round = 0; round < 5; ++round) {
    const auto opened = FastExr::open(file("a.exr"));
    ASSERT_TRUE(opened);
    try {
      const int wanted[] = {0};
      opened->readFloats(0, wanted);
      FAIL() << "half a file was read";
    } catch (const InputError& error) {
      if (round == 0) first = error.what();
      EXPECT_EQ(first, error.what());
    }
  }
  EXPECT_NE(first.find("a.exr: the chunk of scanline "), std::string::npos) << first;
  EXPECT_EQ(first.find("scanline -10 "), std::string::npos) << first;
}

}  // namespace
}  // namespace kagefude
