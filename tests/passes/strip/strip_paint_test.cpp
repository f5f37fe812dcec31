#include "passes/strip/strip_paint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "passes/strip/strip_check.h"

namespace kagefude {
namespace {

StripReport reportOf(const PaintedStrip& picture) {
  return checkStrip(picture.r, picture.g, picture.b);
}

TEST(StripPaint, ShippedStripsPassTheirCheck) {
  for (const std::string_view name : stripPresets) {
    const PaintedStrip picture = paintStrip(stripPreset(name));
    const StripReport report = reportOf(picture);
    EXPECT_TRUE(report.problems.empty()) << name << ": " << report.problems.front();
    EXPECT_LT(report.seamRatio, 2.0f) << name;
    EXPECT_EQ(report.width, 512);
  }
  EXPECT_THROW(stripPreset("sfot"), UsageError);
}

TEST(StripPaint, SameSeedSameBitsOtherSeedOtherStrokes) {
  StripPaintParams params;
  params.width = params.height = 64;
  const PaintedStrip a = paintStrip(params), b = paintStrip(params);
  EXPECT_EQ(std::memcmp(a.r.row(0), b.r.row(0), 64 * 64 * sizeof(float)), 0);
  params.seed = 2;
  EXPECT_NE(std::memcmp(a.r.row(0), paintStrip(params).r.row(0), 64 * 64 * sizeof(float)), 0);
}

TEST(StripPaint, StrokesShowAlongAndAcross) {
  const PaintedStrip picture = paintStrip({});
  // Unevenness along a row, which a plain gradient has not.
  double mean = 0, squares = 0;
  for (int x = 0; x < 512; ++x) {
    mean += picture.g(x, 256) / 512.0;
    squares += picture.g(x, 256) * picture.g(x, 256) / 512.0;
  }
  EXPECT_GT(std::sqrt(squares - mean * mean), 0.005);
}

TEST(StripPaint, WideStrokesMakeBroaderSteps) {
  // The widest step of a column is broader under a broad brush: count its turning points.
  const auto turns = [](float strokeWidth) {
    StripPaintParams params;
    params.strokeWidth = strokeWidth;
    params.bristle = 0;
    const PaintedStrip picture = paintStrip(params);
    int count = 0;
    for (int x = 0; x < 512; x += 16)
      for (int y = 1; y < 511; ++y) {
        const float up = picture.g(x, y - 1) - picture.g(x, y);
        const float down = picture.g(x, y) - picture.g(x, y + 1);
        count += up * down < 0;
      }
    return count;
  };
  EXPECT_GT(turns(12), 2 * turns(80));
}

TEST(StripPaint, BandsAreFlatBetweenTheSteps) {
  StripPaintParams params = stripPreset("cel");
  const PaintedStrip picture = paintStrip(params);
  for (int band = 0; band < 4; ++band) {
    const int row = 511 - (band * 128 + 64);
    for (int x = 1; x < 512; ++x) ASSERT_NEAR(picture.r(x, row), picture.r(0, row), 2e-3f);
  }
}

TEST(StripPaint, RefusesUnusableStops) {
  StripPaintParams params;
  params.stops = {0, 0, 0, 0};
  EXPECT_THROW(paintStrip(params), LookError);
  params.stops = {0, 0, 0, 0, 0, 1, 1, 1};
  EXPECT_THROW(paintStrip(params), LookError) << "places do not rise";
  params.stops = {0.1f, 0, 0, 0, 1, 1, 1, 1};
  EXPECT_THROW(paintStrip(params), LookError) << "does not start at 0";
  params.stops = {0, 0, 0, 0, 1, 1, 1};
  EXPECT_THROW(paintStrip(params), LookError);
}

TEST(StripCheck, FindsASeam) {
  Floats ramp(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      ramp(x, y) = 0.5f * (1 - static_cast<float>(y) / 64) + 0.3f * static_cast<float>(x) / 64;
  const StripReport report = checkStrip(ramp, ramp, ramp);
  EXPECT_NEAR(report.seamRatio, 63.0f, 0.1f);
  ASSERT_EQ(report.problems.size(), 1u);
  EXPECT_NE(report.problems[0].find("do not join"), std::string::npos);
}

TEST(StripCheck, FindsAnUpsideDownStrip) {
  StripPaintParams params;
  const PaintedStrip picture = paintStrip(params);
  Floats turned(512, 512);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) turned(x, y) = picture.g(x, 511 - y);
  const StripReport report = checkStrip(turned, turned, turned);
  ASSERT_FALSE(report.problems.empty());
  EXPECT_NE(report.problems[0].find("upside down"), std::string::npos);
}

TEST(StripCheck, FindsABrightBandInTheDark) {
  Floats values(32, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 32; ++x)
      values(x, y) = (y >= 40 && y < 48) ? 0.9f : 1 - static_cast<float>(y) / 64;
  const StripReport report = checkStrip(values, values, values);
  ASSERT_EQ(report.problems.size(), 1u);
  EXPECT_NE(report.problems[0].find("rise steadily"), std::string::npos);
}

TEST(StripCheck, EmptyAndTinyAndBroken) {
  EXPECT_EQ(checkStrip({}, {}, {}).problems.size(), 1u);
  Floats tiny(4, 4, 0.5f);
  EXPECT_GE(checkStrip(tiny, tiny, tiny).problems.size(), 1u);
  tiny(0, 0) = std::numeric_limits<float>::infinity();
  EXPECT_NE(checkStrip(tiny, tiny, tiny).problems[0].find("NaN"), std::string::npos);
}

}  // namespace
}  // namespace kagefude
