#include "exr/write_image.h"

#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTimeCode.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>

#include "base/atomic_file.h"
#include "frame/frame_fixtures.h"
#include "picture/strip_file.h"

namespace kagefude {
namespace {

using namespace testing;

TEST(WriteExr, EveryTypeAndCodecComesBackBitForBit) {
  const TemporaryFolder folder;
  const Window window{-3, 5, 37, 300};
  Floats values(window.width, window.height);
  Labels words(window.width, window.height);
  Plane<uint16_t> halves(window.width, window.height);
  for (int i = 0; i < window.width * window.height; ++i) {
    const uint32_t hash = static_cast<uint32_t>(i) * 2654435761u;
    words.row(0)[i] = hash;
    halves.row(0)[i] = static_cast<uint16_t>(hash >> 16);
    values.row(0)[i] = static_cast<float>(hash) * 1e-3f;
  }
  for (const auto codec : {Compression::none, Compression::rle, Compression::zips, Compression::zip,
                           Compression::piz}) {
    OutputImage image;
    image.dataWindow = window;
    image.displayWindow = {0, 0, 100, 100};
    image.pixelAspect = 2.0f;
    image.compression = codec;
    image.channels = {floatChannel("f", PixelType::single, values), labelChannel("u", words)};
    image.channels.push_back({"h", PixelType::half, {}, halves, {}});
    image.channels.push_back({"bits", PixelType::single, {}, {}, words});
    writeExr(folder / "a.exr", image);
    const ImageFile file = openImage(folder / "a.exr");
    EXPECT_EQ(file.dataWindow, window);
    EXPECT_EQ(file.displayWindow, (Window{0, 0, 100, 100}));
    EXPECT_EQ(file.pixelAspect, 2.0f);
    const auto raw = readRaw(file, std::vector<std::string>{"f", "u", "h", "bits"});
    for (size_t i = 0; i < values.view().pixels(); ++i) {
      ASSERT_EQ(raw[0].words.row(0)[i], std::bit_cast<uint32_t>(values.row(0)[i]));
      ASSERT_EQ(raw[1].words.row(0)[i], words.row(0)[i]);
      ASSERT_EQ(raw[2].halves.row(0)[i], halves.row(0)[i]);
      ASSERT_EQ(raw[3].words.row(0)[i], words.row(0)[i]) << "NaN patterns included";
    }
  }
}

TEST(WriteExr, HalfHoldsLargeFiniteValues) {
  const TemporaryFolder folder;
  Floats values(4, 1);
  values(0, 0) = 1e10f;
  values(1, 0) = -1e10f;
  values(2, 0) = INFINITY;
  values(3, 0) = 0.1f;
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, 4, 1};
  image.channels = {floatChannel("R", PixelType::half, values)};
  writeExr(folder / "a.exr", image);
  const auto back = readFloats(openImage(folder / "a.exr"), std::vector<std::string>{"R"});
  EXPECT_EQ(back[0](0, 0), 65504.0f);
  EXPECT_EQ(back[0](1, 0), -65504.0f);
  EXPECT_EQ(back[0](2, 0), INFINITY);
  EXPECT_EQ(back[0](3, 0), 0.0999755859375f) << "the nearest half";
}

class WriteMetadata : public ::testing::TestWithParam<bool> {};

TEST_P(WriteMetadata, IsCarriedButNotThatOfStorage) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"R"}, PixelType::half, {0, 0, 4, 3}, {{"owner", "someone"}});
  ImageFile source = openImage(folder / "a.exr");
  auto headers = std::make_shared<std::vector<Imf::Header>>(*source.headers);
  Imf::addTimeCode(headers->front(), Imf::TimeCode(1, 2, 3, 4));
  Imf::addFramesPerSecond(headers->front(), Imf::Rational(24000, 1001));
  headers->front().setView("left");
  source.headers = headers;

  Floats values(6, 2, 1.0f);
  OutputImage image;
  image.dataWindow = image.displayWindow = {1, 1, 6, 2};
  image.compression = Compression::zips;
  image.channels = {floatChannel("Y", PixelType::single, values)};
  image.source = &source;
  image.attributes["kagefude/version"] = "1";
  // A type that the fast writer does not know goes the other way; both must carry everything.
  if (GetParam())
    headers->front().insert("crop", Imf::Box2iAttribute(Imath::Box2i({1, 2}, {3, 4})));
  writeExr(folder / "b.exr", image);
  const ImageFile file = openImage(folder / "b.exr");
  const Imf::Header& header = file.headers->front();
  EXPECT_EQ(Imf::timeCode(header).seconds(), 3);
  EXPECT_EQ(Imf::framesPerSecond(header).d, 1001u);
  EXPECT_EQ(header.view(), "left");
  EXPECT_EQ(file.text("owner"), "someone");
  EXPECT_EQ(file.text("kagefude/version"), "1");
  EXPECT_EQ(file.compression, "zips");
  EXPECT_EQ(file.dataWindow, (Window{1, 1, 6, 2}));
  EXPECT_EQ(file.channelNames(), std::vector<std::string>{"Y"});
  EXPECT_EQ(header.findTypedAttribute<Imf::Box2iAttribute>("crop") != nullptr, GetParam());
}

INSTANTIATE_TEST_SUITE_P(BothWriters, WriteMetadata, ::testing::Bool());

TEST(WriteExr, RefusesWrongPlanesAndLeavesNothing) {
  const TemporaryFolder folder;
  Floats values(4, 4, 0.0f);
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, 4, 3};
  image.channels = {floatChannel("R", PixelType::half, values)};
  expectContains(messageOf<OutputError>([&] { writeExr(folder / "a.exr", image); }),
                 "channel R is 4 x 4 pixels in a data window of 4 x 3");
  image.dataWindow.height = 4;
  image.channels.push_back(image.channels.front());
  expectContains(messageOf<OutputError>([&] { writeExr(folder / "a.exr", image); }),
                 "channel R is given twice");
  EXPECT_TRUE(folder.names().empty());
}

TEST(WriteExr, MissingFolderIsNamed) {
  const TemporaryFolder folder;
  expectContains(messageOf<OutputError>([&] { writeChannels(folder / "no/a.exr", {"R"}); }),
                 "no: No such file or directory");
}

// A limit on file size fails writes as a full disk does; the signal that comes with it is ignored.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(WriteExr, FullDiskLeavesTheOldFileAndNoTemporary) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"R"});
  const auto before = std::filesystem::file_size(folder / "a.exr");
  // Limits that hit the header, the pixels and only the last bytes.
  Floats values(512, 512);
  for (size_t i = 0; i < values.view().pixels(); ++i) values.row(0)[i] = std::sqrt(float(i));
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, 512, 512};
  image.compression = Compression::none;
  image.channels = {floatChannel("R", PixelType::single, values)};
  writeExr(folder / "whole.exr", image);
  const auto whole = std::filesystem::file_size(folder / "whole.exr");
  for (const auto limit : {uintmax_t{10}, whole / 2, whole - 1}) {
    const SizeLimit guard(limit);
    expectContains(messageOf<OutputError>([&] { writeExr(folder / "a.exr", image); }),
                   "File too large");
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "a.exr"), before);
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(AtomicFile, AppearsOnCommitOnly) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a.txt");
    file.write("abc", 3);
    ASSERT_EQ(folder.names().size(), 1u);
    EXPECT_TRUE(parseTempName(folder.names()[0])) << folder.names()[0];
    file.commit();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
  }
  {
    AtomicFile file(folder / "b.txt");
    file.write("abc", 3);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, SeeksBackToPatch) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt");
  file.write("0123456789", 10);
  file.seek(2);
  file.write("xy", 2);
  EXPECT_EQ(file.position(), 4u);
  file.commit();
  std::string text;
  std::ifstream(folder / "a.txt") >> text;
  EXPECT_EQ(text, "01xy456789");
}

TEST(AtomicFile, NamesOfGreatestLengthWork) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  AtomicFile file(folder / name);
  file.commit();
  EXPECT_EQ(folder.names(), std::vector<std::string>{name});
}

TEST(WritePng, RoundsClampsAndKeepsAlphaApart) {
  const TemporaryFolder folder;
  Floats red(3, 1), green(3, 1, 0.5f), blue(3, 1, 1.0f), alpha(3, 1, 0.25f);
  red(0, 0) = -1.0f;
  red(1, 0) = 2.0f;
  red(2, 0) = NAN;
  writePng(folder / "a.png", red, green, blue, alpha, 8);
  writePng(folder / "b.png", red, green, blue, {}, 16);
  const StripPicture a = readStrip(folder / "a.png"), b = readStrip(folder / "b.png");
  EXPECT_EQ(a.red(0, 0), 0.0f);
  EXPECT_EQ(a.red(1, 0), 1.0f);
  EXPECT_EQ(a.red(2, 0), 0.0f);
  EXPECT_FLOAT_EQ(a.green(0, 0), 128.0f / 255.0f) << "not multiplied by alpha";
  EXPECT_FLOAT_EQ(a.alpha(0, 0), 64.0f / 255.0f);
  EXPECT_FLOAT_EQ(b.green(0, 0), 32768.0f / 65535.0f);
  EXPECT_FALSE(b.hasAlpha);
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(WritePng, RefusesPlanesOfDifferentSizes) {
  const TemporaryFolder folder;
  const Floats small(2, 2, 0.0f), large(3, 2, 0.0f);
  EXPECT_THROW(writePng(folder / "a.png", small, large, small), OutputError);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace kagefude
