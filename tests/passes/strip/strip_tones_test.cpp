#include "passes/strip/strip_tones.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "image/oklab.h"
#include "passes/strip/strip_check.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

TEST(Oklab, HasThePublishedValues) {
  // White, and the table of Ottosson's post: XYZ (0.950, 1, 1.089) is L 1, a 0, b 0; pure sRGB red
  // is 0.62796, 0.22486, 0.12585.
  const V3f white = oklabOfLinear(V3f(1.0f)), red = oklabOfLinear({1, 0, 0});
  EXPECT_NEAR(white.x, 1.0f, 1e-4f);
  EXPECT_NEAR(white.y, 0.0f, 1e-4f);
  EXPECT_NEAR(red.x, 0.62796f, 1e-4f);
  EXPECT_NEAR(red.y, 0.22486f, 1e-4f);
  EXPECT_NEAR(red.z, 0.12585f, 1e-4f);
}

TEST(Oklab, ThereAndBackIsTheSame) {
  for (const V3f& c : {V3f(0.2f, 0.5f, 0.8f), V3f(0.9f, 0.1f, 0.4f), V3f(0.0f), V3f(1.0f)}) {
    const V3f back = srgbOfOklab(oklabOfSrgb(c));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], c[i], 2e-3f);
  }
}

TEST(Oklab, WhatCannotBeShownKeepsHueAndLightness) {
  const V3f wanted(0.8f, 0.3f, -0.2f);
  const V3f got = oklabOfSrgb(srgbOfOklab(wanted));
  EXPECT_NEAR(got.x, wanted.x, 0.01f);
  EXPECT_NEAR(std::atan2(got.z, got.y), std::atan2(wanted.z, wanted.y), 0.03f);
}

TEST(Oklab, LeansTowardsWarmButNotBeyond) {
  // A hue of 60 degrees is 20 from warm (80): by 10 it goes half way, by 40 it arrives.
  const auto hueOf = [](const V3f& lab) { return std::atan2(lab.z, lab.y) * 57.29578f; };
  const float turn = 60.0f / 57.29578f;
  const V3f lab(0.5f, 0.3f * std::cos(turn), 0.3f * std::sin(turn));
  EXPECT_NEAR(hueOf(leanTowardsWarm(lab, 10)), 70.0f, 0.8f);
  EXPECT_NEAR(hueOf(leanTowardsWarm(lab, 40)), 80.0f, 0.1f);
  EXPECT_EQ(leanTowardsWarm(lab, 0), lab);
  EXPECT_LT(leanTowardsWarm(V3f(0.5f, 0, 0), -30).z, -0.01f) << "greys lean to blue";
}

TEST(StripTones, APointIsLiftPlusScaleTimesTheOwnLightness) {
  // Grey of linear 0.125 has lightness 0.5.
  constexpr TonePoint ramp[] = {{0, 0.1f, 0.4f, 1}, {1, 0.5f, 0.6f, 1}};
  const std::vector<float> stops = tonesOf(V3f(0.125f), ramp);
  ASSERT_EQ(stops.size(), 8u);
  EXPECT_EQ(stops[4], 1.0f);
  EXPECT_NEAR(oklabOfSrgb({stops[1], stops[2], stops[3]}).x, 0.3f, 1e-3f);
  EXPECT_NEAR(oklabOfSrgb({stops[5], stops[6], stops[7]}).x, 0.8f, 1e-3f);
}

TEST(StripTones, APaletteIsSortedByLightness) {
  const std::vector<float> stops =
      stopsOfPalette({V3f(1, 1, 0.9f), V3f(0.1f, 0.1f, 0.2f), V3f(0.7f, 0.3f, 0.2f)});
  ASSERT_EQ(stops.size(), 17u * 4);
  EXPECT_NEAR(stops[1], 0.1f, 2e-3f);
  EXPECT_NEAR(stops[8 * 4], 0.5f, 1e-6f) << "each colour has the same share";
  EXPECT_NEAR(stops[8 * 4 + 1], 0.7f, 2e-3f);
  EXPECT_NEAR(stops[16 * 4 + 3], 0.9f, 2e-3f);
  // Half way in Oklab's lightness.
  const auto lightness = [&](size_t i) {
    return oklabOfSrgb({stops[4 * i + 1], stops[4 * i + 2], stops[4 * i + 3]}).x;
  };
  EXPECT_NEAR(lightness(4), 0.5f * (lightness(0) + lightness(8)), 2e-3f);
  EXPECT_THROW(stopsOfPalette({V3f(0.5f)}), InputError);
  EXPECT_THROW(stopsOfPalette({V3f(0.5f), V3f(0.51f)}), InputError);
}

TEST(StripPaint, HueShiftWarmsTheLightAndCoolsTheShadow) {
  StripPaintParams params;
  params.width = params.height = 64;
  params.stops = {0, 0.3f, 0.3f, 0.3f, 1, 0.8f, 0.8f, 0.8f};
  params.hueShift = 40;
  const PaintedStrip strip = paintStrip(params);
  EXPECT_GT(strip.r(10, 1), strip.b(10, 1) + 0.02f);
  EXPECT_GT(strip.b(10, 62), strip.r(10, 62) + 0.02f);
}

TEST(StripPaint, EveryWayOfPaintingPassesTheCheck) {
  for (const auto set :
       {+[](StripPaintParams& p) { p.relief = 1; }, +[](StripPaintParams& p) { p.tooth = 1; },
        +[](StripPaintParams& p) { p.pool = 1; }, +[](StripPaintParams& p) { p.under = 0.2f; },
        +[](StripPaintParams& p) {
          p.hatch = 1;
          p.strokeWidth = 16;
        },
        +[](StripPaintParams& p) {
          p.hatch = 2;
          p.strokeWidth = 16;
        }}) {
    StripPaintParams params;
    params.stops = {0, 0.2f, 0.2f, 0.3f, 1, 1, 1, 0.9f};
    const PaintedStrip plain = paintStrip(params);
    set(params);
    const PaintedStrip strip = paintStrip(params);
    const StripReport report = checkStrip(strip.r, strip.g, strip.b);
    EXPECT_TRUE(report.problems.empty()) << report.problems.front();
    double changed = 0;
    for (int y = 0; y < 512; ++y)
      for (int x = 0; x < 512; ++x) changed += std::fabs(strip.g(x, y) - plain.g(x, y)) / 262144.0;
    EXPECT_GT(changed, 0.002) << "it does nothing";
  }
}

}  // namespace
}  // namespace kagefude
