#include "passes/strip/strip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "passes/strip/stroke_noise.h"

namespace kagefude {
namespace {

Strip stripOf(const Floats& values) { return makeStrip(values, values, values); }

Strip noiseStrip(int width, int height) {
  Floats values(width, height);
  StrokeNoise noise(5, 7);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) values(x, y) = noise.next();
  return stripOf(values);
}

TEST(Strip, ToneOneIsTheTopRow) {
  Floats values(2, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 2; ++x) values(x, y) = static_cast<float>(y);
  const Strip strip = stripOf(values);
  EXPECT_EQ(stripBilinear(strip, 0.3f, 1.0f)[0], 0.0f);
  EXPECT_EQ(stripBilinear(strip, 0.3f, 0.0f)[0], 3.0f);
  EXPECT_FLOAT_EQ(stripBilinear(strip, 0.3f, 0.5f)[0], 1.5f);
  EXPECT_FLOAT_EQ(stripBilinear(strip, 0.3f, 0.875f)[0], 0.0f) << "centre of the top row";
  EXPECT_EQ(stripBilinear(strip, 0.3f, -4.0f)[0], 3.0f) << "clamped";
  EXPECT_EQ(stripBilinear(strip, 0.3f, 9.0f)[0], 0.0f) << "clamped";
  EXPECT_EQ(stripBilinear(strip, 0.3f, 0.5f)[3], 1.0f) << "opaque without an alpha plane";
}

TEST(Strip, LeftAndRightEdgesJoin) {
  Floats values(4, 1);
  for (int x = 0; x < 4; ++x) values(x, 0) = static_cast<float>(x);
  const Strip strip = stripOf(values);
  EXPECT_FLOAT_EQ(stripBilinear(strip, 0.0f, 0.5f)[0], 1.5f) << "between the last and the first";
  EXPECT_FLOAT_EQ(stripBilinear(strip, 7.125f, 0.5f)[0], 0.0f) << "centre of the first";
  EXPECT_FLOAT_EQ(stripBilinear(strip, -0.125f, 0.5f)[0], 3.0f) << "centre of the last";
  EXPECT_FLOAT_EQ(stripBilinear(strip, -1e-12f, 0.5f)[0], 1.5f) << "wraps to one exactly";
}

TEST(Strip, EveryLevelKeepsTheMeanAlsoAtOddSizes) {
  const Strip strip = noiseStrip(37, 23);
  double mean = 0;
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 37; ++x) mean += strip.levels[0].texels(x, y)[1] / (37.0 * 23.0);
  for (const Strip::Level& level : strip.levels) {
    double sum = 0;
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x) sum += level.texels(x, y)[1];
    EXPECT_NEAR(sum / (level.width * level.height), mean, 1e-5);
  }
  EXPECT_EQ(strip.levels.back().width, 1);
  EXPECT_EQ(strip.levels.back().height, 1);
}

TEST(Strip, SmallFootprintIsBilinearToTheBit) {
  const Strip strip = noiseStrip(64, 64);
  const Footprint footprint{0.005f, 0.002f, -0.003f, 0.004f};
  for (int i = 0; i < 200; ++i) {
    const float u = 0.013f * static_cast<float>(i), v = 0.005f * static_cast<float>(i);
    const Rgba a = stripFiltered(strip, u, v, footprint, 8), b = stripBilinear(strip, u, v);
    ASSERT_EQ(a[0], b[0]);
  }
}

// Mean of bilinear lookups over the parallelogram of the footprint.
float supersampled(const Strip& strip, float u, float v, const Footprint& f) {
  constexpr int side = 48;
  double sum = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const float s = (static_cast<float>(i) + 0.5f) / side - 0.5f;
      const float t = (static_cast<float>(j) + 0.5f) / side - 0.5f;
      sum += stripBilinear(strip, u + s * f.ux + t * f.uy, v + s * f.vx + t * f.vy)[0];
    }
  return static_cast<float>(sum / (side * side));
}

TEST(Strip, FilteringMatchesSupersampling) {
  const Strip strip = noiseStrip(128, 128);
  const Footprint shapes[] = {{0.06f, 0, 0, 0.06f},           // round, 8 texels
                              {0.10f, 0.02f, -0.01f, 0.02f},  // stretched along u
                              {0.01f, 0.12f, 0.01f, 0.0f},    // along v
                              {0.09f, 0.09f, 0.02f, -0.02f},  // slanting
                              {0.5f, 0.0f, 0.0f, 0.01f}};     // longer than its probes reach
  for (const Footprint& shape : shapes) {
    double filtered = 0, pointed = 0;
    constexpr int samples = 300;
    StrokeNoise noise(1, 2);
    for (int i = 0; i < samples; ++i) {
      const float u = noise.next() * 3.0f, v = 0.2f + 0.6f * noise.next();
      const float truth = supersampled(strip, u, v, shape);
      filtered += std::pow(stripFiltered(strip, u, v, shape, 64)[0] - truth, 2) / samples;
      pointed += std::pow(stripBilinear(strip, u, v)[0] - truth, 2) / samples;
    }
    // White noise is the hardest case: one texel's deviation is 0.29.
    EXPECT_LT(std::sqrt(filtered), 0.04) << shape.ux << " " << shape.vx;
    EXPECT_LT(filtered, pointed / 9) << shape.ux << " " << shape.vx;
  }
}

TEST(Strip, FewProbesBlurInsteadOfAliasing) {
  const Strip strip = noiseStrip(256, 256);
  const Footprint wide{0.5f, 0, 0, 1.0f / 256};
  double variance = 0;
  for (int i = 0; i < 400; ++i) {
    const float c = stripFiltered(strip, 0.0025f * static_cast<float>(i), 0.5f, wide, 2)[0] - 0.5f;
    variance += c * c / 400;
  }
  EXPECT_LT(variance, 0.0004) << "an unfiltered row's variance is about 0.06";
}

TEST(Strip, RowMeanByHand) {
  Floats values(2, 2);
  values(0, 0) = 1;
  values(1, 0) = 3;
  values(0, 1) = 5;
  values(1, 1) = 9;
  const Strip strip = stripOf(values);
  EXPECT_FLOAT_EQ(stripRowMean(strip, 1)[0], 2.0f);
  EXPECT_FLOAT_EQ(stripRowMean(strip, 0)[0], 7.0f);
  EXPECT_FLOAT_EQ(stripRowMean(strip, 0.5f)[0], 4.5f);
}

TEST(Strip, EmptyAndBrokenInput) {
  EXPECT_THROW(makeStrip({}, {}, {}), InputError);
  Floats nan(1, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(stripBilinear(stripOf(nan), 0.5f, 0.5f)[0], 0.0f);
  Floats one(1, 1, 0.5f);
  const Strip single = stripOf(one);
  EXPECT_EQ(stripFiltered(single, 3.7f, 0.1f, {9, 9, -9, 9}, 8)[0], 0.5f);
  const float bad = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(stripFiltered(single, 0, 0, {bad, bad, bad, bad}, 8)[0], 0.5f);
}

}  // namespace
}  // namespace kagefude
