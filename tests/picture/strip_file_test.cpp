#include "picture/strip_file.h"

#include "frame/frame_fixtures.h"
#include "picture/png_file.h"

namespace kagefude {
namespace {

using namespace testing;

TEST(StripFile, FloatFilesAreTakenForLinear) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"R", "G", "B"});
  const StripPicture strip = readStrip(folder / "a.exr");
  EXPECT_TRUE(strip.sceneLinear);
  EXPECT_EQ(strip.width(), 4);
  EXPECT_EQ(strip.green(2, 1), 106.0f);
  EXPECT_EQ(strip.alpha(2, 1), 1.0f);
}

TEST(StripFile, OneChannelFillsAllThree) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"Y"});
  const StripPicture strip = readStrip(folder / "a.exr");
  EXPECT_EQ(strip.red(3, 2), 11.0f);
  EXPECT_EQ(strip.blue(3, 2), 11.0f);
}

TEST(StripFile, MissingBrokenAndTruncatedFilesAreNamed) {
  const TemporaryFolder folder;
  expectContains(messageOf<InputError>([&] { readStrip(folder / "none.png"); }),
                 "none.png does not exist");
  writeText(folder / "text.png", "no picture");
  expectContains(messageOf<InputError>([&] { readStrip(folder / "text.png"); }),
                 "text.png cannot be read");
  const Floats plane(64, 64, 0.5f);
  writePng(folder / "cut.png", plane, plane, plane);
  std::filesystem::resize_file(folder / "cut.png",
                               std::filesystem::file_size(folder / "cut.png") - 60);
  expectContains(messageOf<InputError>([&] { readStrip(folder / "cut.png"); }), "cut.png");
}

TEST(StripFile, DamagedPicturesOfOtherFormatsAreNamed) {
  const TemporaryFolder folder;
  writeText(folder / "a.png", std::string("II*\0\0\0\0\0", 8));
  expectContains(messageOf<InputError>([&] { readStrip(folder / "a.png"); }),
                 "a.png cannot be read");
}

TEST(PngFile, KeepsSamplesOfEveryChannelCountAndDepth) {
  const TemporaryFolder folder;
  for (const int channels : {1, 2, 3, 4})
    for (const int bits : {8, 16}) {
      PngPicture picture{5, 3, channels, bits, {}};
      for (int i = 0; i < 15 * channels; ++i)
        picture.samples.push_back(static_cast<uint16_t>(i * (bits == 16 ? 1021 : 4)));
      const auto bytes = encodePng(picture, {{"kagefude/note", "a b"}});
      writeText(folder / "a.png", std::string(bytes.begin(), bytes.end()));
      const PngPicture read = readPng(folder / "a.png");
      EXPECT_EQ(read.samples, picture.samples) << channels << " channels, " << bits << " bits";
      EXPECT_EQ(read.channels, channels);
      EXPECT_EQ(read.bits, bits);
      EXPECT_EQ(readPngText(folder / "a.png", "kagefude/note"), "a b");
      EXPECT_FALSE(readPngText(folder / "a.png", "other"));
    }
}

TEST(PngFile, DamageAnywhereIsAnErrorOrAPicture) {
  const TemporaryFolder folder;
  PngPicture picture{16, 16, 3, 8, {}};
  for (int i = 0; i < 16 * 16 * 3; ++i) picture.samples.push_back(static_cast<uint16_t>(i % 256));
  const auto whole = encodePng(picture, {});
  size_t errors = 0;
  for (size_t at = 0; at < whole.size(); ++at) {
    auto bytes = whole;
    bytes[at] ^= 0xFF;
    writeText(folder / "a.png", std::string(bytes.begin(), bytes.end()));
    try {
      readPng(folder / "a.png");
    } catch (const InputError&) {
      ++errors;
    }
    bytes.resize(at);
    writeText(folder / "cut.png", std::string(bytes.begin(), bytes.end()));
    EXPECT_THROW(readPng(folder / "cut.png"), InputError) << "cut at " << at;
  }
  EXPECT_GT(errors, whole.size() / 2);
}

}  // namespace
}  // namespace kagefude
