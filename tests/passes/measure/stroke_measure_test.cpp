#include "passes/measure/stroke_measure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kagefude {
namespace {

struct Picture {
  Labels ids{64, 64, 3u};
  Floats tone{64, 64};
  Vec3Plane colour{64, 64};

  // Colour follows the tone, with waves of a length and strength on top.
  Picture(float strength, float length) {
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        tone(x, y) = static_cast<float>(y) / 63.0f;
        const float wave = strength * std::sin(6.2831853f * static_cast<float>(x) / length);
        colour.set(x, y, V3f(0.2f + 0.6f * tone(x, y) + wave));
      }
  }
  StrokeMeasure measure() const {
    ToneColours colours;
    colours.add(ids, tone, colour);
    return measureStrokes(ids, colour, colours.plain(ids, tone));
  }
};

TEST(StrokeMeasure, PlainColoursAreFoundAgain) {
  const Picture picture(0.1f, 16);
  ToneColours colours;
  colours.add(picture.ids, picture.tone, picture.colour);
  const Vec3Plane plain = colours.plain(picture.ids, picture.tone);
  for (int y = 0; y < 64; ++y)
    ASSERT_NEAR(plain.y(20, y), 0.2f + 0.6f * picture.tone(20, y), 2e-3f) << y;
}

TEST(StrokeMeasure, ContrastAndWavelengthByHand) {
  const StrokeMeasure measure = Picture(0.1f, 16).measure();
  double plain = 0;
  for (int y = 1; y < 63; ++y) plain += std::pow(0.2 + 0.6 * y / 63.0, 2) / 62;
  EXPECT_NEAR(measure.contrast, 0.1 / std::sqrt(2.0) / std::sqrt(plain), 2e-3);
  // Central differences see the slope of a wave of 16 pixels as sin(a) / a of it, a = 2π / 16.
  EXPECT_NEAR(measure.grain, 16 * 0.3927 / std::sin(0.3927), 0.6);
  EXPECT_EQ(measure.pixels, 62 * 62);
}

TEST(StrokeMeasure, NoStrokesGiveNothing) {
  const StrokeMeasure measure = Picture(0, 16).measure();
  EXPECT_NEAR(measure.contrast, 0, 1e-3);
}

TEST(StrokeMeasure, ObjectsHaveTheirOwnColours) {
  Picture picture(0, 16);
  for (int y = 0; y < 64; ++y)
    for (int x = 32; x < 64; ++x) {
      picture.ids(x, y) = 7;
      picture.colour.set(x, y, {0.9f, 0.1f, 0.1f});
    }
  ToneColours colours;
  colours.add(picture.ids, picture.tone, picture.colour);
  const Vec3Plane plain = colours.plain(picture.ids, picture.tone);
  EXPECT_NEAR(plain.x(40, 30), 0.9f, 1e-5f);
  EXPECT_NEAR(plain.x(10, 63), 0.8f, 1e-5f);
}

TEST(StrokeMeasure, BackgroundAndBrokenPixelsDoNotCount) {
  Picture picture(0.1f, 16);
  picture.ids.fill(0);
  EXPECT_EQ(picture.measure().pixels, 0);
  Picture broken(0, 16);
  broken.colour.x(5, 5) = std::nanf("");
  EXPECT_TRUE(std::isfinite(broken.measure().contrast));
}

}  // namespace
}  // namespace kagefude
