#include "colour/colour.h"

#include <OpenColorIO/OpenColorABI.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <latch>
#include <thread>

#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

// The curve of IEC 61966-2-1.
float linearOf(float coded) {
  return coded <= 0.04045f ? coded / 12.92f : std::pow((coded + 0.055f) / 1.055f, 2.4f);
}

class ColourTest : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("OCIO"); }
  Floats ramp() const {
    Floats plane(256, 1);
    for (int x = 0; x < 256; ++x) plane(x, 0) = static_cast<float>(x) / 255.0f;
    return plane;
  }
};

TEST_F(ColourTest, BuiltInSrgbIsTheStandardsCurve) {
  const Colour colour;
  EXPECT_EQ(colour.source(), "built-in");
  Floats red = ramp(), green = ramp(), blue = ramp();
  colour.toWorking(red, green, blue, "sRGB");
  // OpenColorIO 2.5 raises to powers a little less exactly.
  const float bound = OCIO_VERSION_HEX < 0x02050000 ? 2e-5f : 2.5e-5f;
  for (int x = 0; x < 256; ++x) {
    EXPECT_NEAR(green(x, 0), linearOf(static_cast<float>(x) / 255.0f), bound) << x;
  }
  colour.toDisplay(red, green, blue);
  for (int x = 0; x < 256; ++x) EXPECT_NEAR(red(x, 0), static_cast<float>(x) / 255.0f, 5e-5f);
}

TEST_F(ColourTest, RawViewAndLinearSpaceChangeNothing) {
  const Colour colour;
  Floats red = ramp(), green = ramp(), blue = ramp();
  const Floats before = ramp();
  colour.toWorking(red, green, blue, "linear");
  colour.toWorking(red, green, blue, "Raw");
  colour.toDisplay(red, green, blue, "sRGB", "Raw");
  for (int x = 0; x < 256; ++x) EXPECT_EQ(red(x, 0), before(x, 0));
}

TEST_F(ColourTest, UnknownNamesAreLookErrorsWithTheNearest) {
  const Colour colour;
  Floats r(1, 1, 0.0f), g(1, 1, 0.0f), b(1, 1, 0.0f);
  expectContains(messageOf<LookError>([&] { colour.toWorking(r, g, b, "sRBG"); }),
                 "has no space sRBG (did you mean sRGB?)");
  expectContains(messageOf<LookError>([&] { colour.toDisplay(r, g, b, "sRGB", "Standart"); }),
                 "has no view Standart (did you mean Standard?)");
  expectContains(messageOf<LookError>([&] { colour.toDisplay(r, g, b, "P3"); }),
                 "has no display P3");
}

TEST_F(ColourTest, ConfigsThatCannotBeUsedAreInputErrors) {
  const TemporaryFolder folder;
  writeText(folder / "bad.ocio", "this: is no config");
  expectContains(messageOf<InputError>([&] { Colour((folder / "bad.ocio").string()); }),
                 "bad.ocio");
  expectContains(messageOf<InputError>([&] { Colour((folder / "none.ocio").string()); }),
                 "none.ocio");
}

/// A studio's configuration: a view whose table is chosen by a context variable, in a subfolder.
std::filesystem::path studioConfig(const TemporaryFolder& folder) {
  std::string text(builtInColourConfig());
  const std::string views = "displays:\n  sRGB:\n";
  const size_t at = text.find(views);
  EXPECT_NE(at, std::string::npos);
  text.insert(at + views.size(), "    - !<View> {name: Graded, colorspace: graded}\n");
  const std::string active = "active_views: [Standard, Raw";
  text.insert(text.find(active) + active.size(), ", Graded");
  text.insert(0, "search_path: luts\n");
  const size_t first = text.find("ocio_profile_version");
  const size_t end = text.find('\n', first) + 1;
  const std::string version = text.substr(first, end - first);
  text.erase(first, end - first);
  text.insert(0, version);
  text +=
      "\n  - !<ColorSpace>\n    name: graded\n    bitdepth: 32f\n    isdata: false\n"
      "    from_reference: !<FileTransform> {src: \"${KAGEFUDE_SHOT}/grade.spi1d\", "
      "interpolation: linear}\n";
  writeText(folder / "studio.ocio", text);
  for (const char* shot : {"a", "b"}) {
    std::filesystem::create_directories(folder / "luts" / shot);
    writeText(folder / "luts" / shot / "grade.spi1d",
              std::string("Version 1\nFrom 0.0 1.0\nLength 2\nComponents 1\n{\n0.0\n") +
                  (*shot == 'a' ? "0.5" : "0.25") + "\n}\n");
  }
  return folder / "studio.ocio";
}

TEST_F(ColourTest, WhatIsNotInUseNeedsNoVariable) {
  const TemporaryFolder folder;
  unsetenv("KAGEFUDE_SHOT");
  const Colour colour(studioConfig(folder).string());
  Floats r(1, 1, 0.5f), g(1, 1, 0.5f), b(1, 1, 0.5f);
  colour.toWorking(r, g, b, "sRGB");
  colour.toDisplay(r, g, b, "sRGB", "Raw");
  EXPECT_FALSE(colour.toDisplayId("sRGB", "Raw").empty());
  expectContains(messageOf<InputError>([&] { colour.toDisplayId("sRGB", "Graded"); }), "grade");
}

TEST_F(ColourTest, AnIdTellsWhatATransformDoes) {
  const TemporaryFolder folder;
  const std::string config = studioConfig(folder).string();
  const auto graded = [&](const char* shot) {
    setenv("KAGEFUDE_SHOT", shot, 1);
    return Colour(config).toDisplayId("sRGB", "Graded");
  };
  const std::string first = graded("a");
  EXPECT_EQ(graded("a"), first);
  EXPECT_NE(graded("b"), first) << "a context variable";
  unsetenv("KAGEFUDE_SHOT");
  EXPECT_EQ(Colour(config).toWorkingId("sRGB"), Colour().toWorkingId("sRGB"));
  EXPECT_NE(Colour().toWorkingId("sRGB"), Colour().toWorkingId("Raw"));
}

TEST_F(ColourTest, ServesSeveralThreadsFromItsFirstCallOn) {
  // OCIO lists displays when first asked; two threads that asked at once found an empty list.
  for (int round = 0; round < 500; ++round) {
    const Colour colour;
    std::atomic<int> failures{0};
    std::latch together(4);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        try {
          Floats r(1, 1, 0.5f), g(1, 1, 0.5f), b(1, 1, 0.5f);
          together.arrive_and_wait();
          colour.toDisplay(r, g, b);
        } catch (const std::exception&) {
          ++failures;
        }
      });
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(failures, 0) << round;
  }
}

TEST_F(ColourTest, EnvironmentNamesTheDefault) {
  const TemporaryFolder folder;
  writeText(folder / "mine.ocio", std::string(builtInColourConfig()));
  setenv("OCIO", (folder / "mine.ocio").c_str(), 1);
  EXPECT_EQ(Colour().source(), (folder / "mine.ocio").string());
  unsetenv("OCIO");
}

}  // namespace
}  // namespace kagefude
