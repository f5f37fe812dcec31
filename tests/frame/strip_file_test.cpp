#include "frame/strip_file.h"

#include "frame_fixtures.h"

#ifdef __SANITIZE_ADDRESS__
// OIIO 2.4 loses its error text when libpng jumps out of a truncated file; that leak is not ours.
extern "C" const char* __lsan_default_suppressions() { return "leak:PngReadCallback\n"; }
#endif

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

}  // namespace
}  // namespace kagefude
