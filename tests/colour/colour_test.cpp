#include "colour/colour.h"

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
  for (int x = 0; x < 256; ++x) {
    EXPECT_NEAR(green(x, 0), linearOf(static_cast<float>(x) / 255.0f), 2e-5f) << x;
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
