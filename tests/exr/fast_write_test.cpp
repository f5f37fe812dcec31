#include "exr/fast_write.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>
#include <algorithm>

#include <fstream>
#include <iterator>

#include "base/error.h"
#include "exr/fast_fixture.h"
#include "exr/fast_read.h"

namespace kagefude {
namespace {

class ExrFastWrite : public ExrFastTest {};

template <class T>
View<const T> viewOf(const TestChannel& channel, const Window& window) {
  return {reinterpret_cast<const T*>(channel.bytes.data()), window.width, window.height};
}

/// The part as an image that is written bit by bit.
ExrImage imageOf(const TestPart& part) {
  ExrImage image;
  image.data = part.data;
  image.display = part.display;
  for (const TestChannel& c : part.channels) {
    if (c.type == ExrType::half) {
      image.channels.push_back({c.name, c.type, viewOf<uint16_t>(c, part.data)});
    } else {
      image.channels.push_back({c.name, c.type, viewOf<uint32_t>(c, part.data)});
    }
  }
  return image;
}

/// The samples of a channel as OpenEXR's C++ library reads them.
std::vector<uint8_t> readWithOpenExr(const std::string& path, const TestPart& part,
                                     const TestChannel& channel) {
  Imf::InputFile in(path.c_str());
  const auto size = static_cast<size_t>(exrTypeBytes(channel.type));
  std::vector<uint8_t> bytes(channel.bytes.size());
  Imf::FrameBuffer frame;
  frame.insert(channel.name, Imf::Slice::Make(in.header().channels()[channel.name.c_str()].type,
                                              bytes.data(), in.header().dataWindow(), size,
                                              size * static_cast<size_t>(part.data.width)));
  in.setFrameBuffer(frame);
  in.readPixels(in.header().dataWindow().min.y, in.header().dataWindow().max.y);
  return bytes;
}

TEST_F(ExrFastWrite, OpenExrReadsBackEveryBit) {
  const Window windows[] = {{0, 0, 64, 48}, {-7, -20, 33, 47}, {5, 9, 1, 1}, {-3, 40, 70, 17}};
  for (const Window& window : windows) {
    for (const TestPixels pixels : {TestPixels::smooth, TestPixels::flat, TestPixels::noise}) {
      for (const auto codec : {ExrCompression::none, ExrCompression::zips, ExrCompression::zip}) {
        for (const auto effort : {ExrEffort::fast, ExrEffort::balanced, ExrEffort::small}) {
          const TestPart part = makeTestPart("", window, Imf::ZIP_COMPRESSION, pixels, 21);
          ExrImage image = imageOf(part);
          image.compression = codec;
          image.effort = effort;
          writeFastExr(file("a.exr"), image);
          for (const TestChannel& c : part.channels) {
            ASSERT_EQ(readWithOpenExr(file("a.exr"), part, c), c.bytes) << c.name;
          }
        }
      }
    }
  }
}

TEST_F(ExrFastWrite, FloatsAreStoredAsFloatsOrAsNearestHalves) {
  Floats plane(70, 20);
  for (size_t i = 0; i < 1400; ++i) plane.row(0)[i] = static_cast<float>(i) * 0.37f - 100;
  ExrImage image;
  image.data = {3, -2, 70, 20};
  image.display = {0, 0, 100, 50};
  image.channels = {{"Z", ExrType::float32, plane.view()}, {"R", ExrType::half, plane.view()}};
  writeFastExr(file("a.exr"), image);
  const auto opened = FastExr::open(file("a.exr"));
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->parts()[0].data, image.data);
  EXPECT_EQ(opened->parts()[0].display, image.display);
  const int wanted[] = {0, 1};
  const auto planes = opened->readFloats(0, wanted);
  for (size_t i = 0; i < 1400; ++i) {
    ASSERT_EQ(planes[0].row(0)[i], static_cast<float>(Imath::half(plane.row(0)[i])));
    ASSERT_EQ(planes[1].row(0)[i], plane.row(0)[i]);
  }
}

TEST_F(ExrFastWrite, OiioFindsTheAttributes) {
  const TestPart part = makeTestPart("", {-5, 4, 8, 8}, Imf::ZIP_COMPRESSION, TestPixels::flat, 1);
  ExrImage image = imageOf(part);
  image.pixelAspect = 2;
  const std::string longName(60, 'n');
  const std::array<float, 16> matrix = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  image.attributes = {
      {"kagefude/look", std::string("[pass]\nx = 1\n")},
      {"frame", int32_t{12}},
      {"exposure", 1.5f},
      {"precise", 0.1},
      {"worldToCamera", matrix},
      {"framesPerSecond", ExrRational{24000, 1001}},
      {"adoptedNeutral", std::array<float, 2>{0.25f, 0.5f}},
      {"light", std::array<float, 3>{1, 2, 3}},
      {"tile", std::array<int32_t, 2>{4, 5}},
      {"corner", std::array<int32_t, 3>{4, 5, 6}},
      {"chromaticities", std::array<float, 8>{.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f}},
      {"uv", std::array<float, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1}},
      {"timeCode", ExrTimeCode{0x01020304, 7}},
      {"views", std::vector<std::string>{"left", "right"}},
      {"weights", std::vector<float>{1, 2, 3, 4, 5}},
      {longName, std::string("long")}};
  writeFastExr(file("a.exr"), image);
  const auto input = OIIO::ImageInput::open(file("a.exr"));
  ASSERT_TRUE(input) << OIIO::geterror();
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_EQ(spec.x, -5);
  EXPECT_EQ(spec.y, 4);
  EXPECT_EQ(spec.full_width, 64);
  EXPECT_EQ(spec.get_float_attribute("PixelAspectRatio"), 2);
  EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
  EXPECT_EQ(spec.get_string_attribute("kagefude/look"), "[pass]\nx = 1\n");
  EXPECT_EQ(spec.get_int_attribute("frame"), 12);
  EXPECT_EQ(spec.get_float_attribute("exposure"), 1.5f);
  EXPECT_EQ(spec.get_string_attribute(longName), "long");
  std::array<float, 16> found;
  ASSERT_TRUE(spec.getattribute("worldtocamera", OIIO::TypeMatrix, found.data()));
  EXPECT_EQ(found, matrix);

  Imf::InputFile in(file("a.exr").c_str());
  EXPECT_EQ(Imf::framesPerSecond(in.header()).n, 24000);
  EXPECT_EQ(Imf::chromaticities(in.header()).white.x, .3127f);
  EXPECT_EQ(Imf::timeCode(in.header()).timeAndFlags(), 0x01020304u);
  EXPECT_EQ(in.header().typedAttribute<Imf::V2fAttribute>("adoptedNeutral").value().y, 0.5f);
  EXPECT_EQ(in.header().typedAttribute<Imf::V3fAttribute>("light").value().z, 3);
  EXPECT_EQ(in.header().typedAttribute<Imf::V2iAttribute>("tile").value().y, 5);
  EXPECT_EQ(in.header().typedAttribute<Imf::V3iAttribute>("corner").value().z, 6);
  EXPECT_EQ(in.header().typedAttribute<Imf::M33fAttribute>("uv").value()[1][1], 1);
  EXPECT_EQ(in.header().typedAttribute<Imf::DoubleAttribute>("precise").value(), 0.1);
  EXPECT_EQ(in.header().typedAttribute<Imf::StringVectorAttribute>("views").value()[1], "right");
  EXPECT_EQ(in.header().typedAttribute<Imf::FloatVectorAttribute>("weights").value()[4], 5);
}

TEST_F(ExrFastWrite, TheSameBytesForAnyNumberOfThreads) {
  const TestPart part =
      makeTestPart("", {0, 0, 400, 300}, Imf::ZIP_COMPRESSION, TestPixels::smooth, 3);
  writeFastExr(file("many.exr"), imageOf(part));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  writeFastExr(file("one.exr"), imageOf(part));
  EXPECT_EQ(contentOf(file("many.exr")), contentOf(file("one.exr")));
}

TEST_F(ExrFastWrite, ChannelsAreSortedWhateverTheirOrder) {
  TestPart part = makeTestPart("", {0, 0, 9, 9}, Imf::ZIP_COMPRESSION, TestPixels::noise, 3);
  writeFastExr(file("a.exr"), imageOf(part));
  std::reverse(part.channels.begin(), part.channels.end());
  writeFastExr(file("b.exr"), imageOf(part));
  EXPECT_EQ(contentOf(file("a.exr")), contentOf(file("b.exr")));
}

TEST_F(ExrFastWrite, RefusesWhatIsNoImage) {
  const TestPart part = makeTestPart("", {0, 0, 9, 9}, Imf::ZIP_COMPRESSION, TestPixels::flat, 3);
  const auto refuses = [&](auto change) {
    ExrImage image = imageOf(part);
    change(image);
    EXPECT_THROW(writeFastExr(file("a.exr"), image), OutputError);
    EXPECT_FALSE(std::filesystem::exists(file("a.exr")));
  };
  refuses([](ExrImage& i) { i.channels.clear(); });
  refuses([](ExrImage& i) { i.channels.push_back(i.channels[0]); });
  refuses([](ExrImage& i) { i.channels[0].name.clear(); });
  refuses([](ExrImage& i) { i.channels[0].name = std::string(256, 'x'); });
  refuses([](ExrImage& i) { i.channels[0].type = ExrType::float32; });
  refuses([](ExrImage& i) { i.channels[1].type = ExrType::half; });
  refuses([](ExrImage& i) { i.data.width = 8; });
  refuses([](ExrImage& i) { i.data.height = 0; });
  refuses([](ExrImage& i) { i.display.x = INT32_MAX; });
  refuses([](ExrImage& i) { i.compression = ExrCompression::rle; });
  refuses([](ExrImage& i) { i.attributes = {{"channels", 1}}; });
  refuses([](ExrImage& i) { i.attributes = {{"twice", 1}, {"twice", 2}}; });
}

TEST_F(ExrFastWrite, ReportsAFullDiskAndAMissingFolder) {
  const TestPart part = makeTestPart("", {0, 0, 9, 9}, Imf::ZIP_COMPRESSION, TestPixels::flat, 3);
  try {
    writeFastExr(file("none/a.exr"), imageOf(part));
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
  try {
    writeFastExr("/dev/full", imageOf(part));
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace kagefude
