#include "passes/light_shape/light_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kagefude {
namespace {

std::vector<V2f> placesOfRings(int ring) {
  std::vector<V2f> places{{0, 0}};
  for (int i = 0; i < ring; ++i) {
    const double angle = 2 * M_PI * i / ring;
    places.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
  }
  return places;
}

TEST(LightShare, TriangleEqualsCountingPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const float a = value(random), b = value(random), c = value(random);
    int positive = 0, all = 0;
    constexpr int steps = 300;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; i + j < steps; ++j, ++all) {
        const float u = (static_cast<float>(i) + 1 / 3.0f) / steps;
        const float v = (static_cast<float>(j) + 1 / 3.0f) / steps;
        positive += a + u * (b - a) + v * (c - a) > 0;
      }
    EXPECT_NEAR(positiveShare(a, b, c), static_cast<double>(positive) / all, 0.01);
  }
}

TEST(LightShare, PairGivesTheSeedsRatio) {
  const V2f places[] = {{-1, 0}, {1, 0}};
  const float s[] = {-1, 3};
  EXPECT_FLOAT_EQ(LightShare(places, false, 1).of(s), 0.75f);
}

TEST(LightShare, LineOfLengthZeroIsTheHardMaskOfItsMiddle) {
  const V2f places[] = {{-1, 0}, {0, 0}, {1, 0}};
  const float dark[] = {5, -0.5f, 5}, lit[] = {-5, 0.5f, -5};
  EXPECT_EQ(LightShare(places, false, 0).of(dark), 0.0f);
  EXPECT_EQ(LightShare(places, false, 0).of(lit), 1.0f);
}

TEST(LightShare, DiscOfLinearDistancesIsTheCircleSegment) {
  for (const int ring : {4, 8})
    for (const float d : {-0.9f, -0.4f, 0.0f, 0.3f, 0.8f}) {
      const std::vector<V2f> places = placesOfRings(ring);
      std::vector<float> s;
      for (const V2f& p : places) s.push_back(2 * (d + 0.6f * p.x + 0.8f * p.y));
      const double exact = 0.5 + (d * std::sqrt(1 - d * d) + std::asin(d)) / M_PI;
      EXPECT_NEAR(LightShare(places, true, 1).of(s.data()), exact, 1e-5);
      EXPECT_NEAR(LightShare(places, false, 1).of(s.data()), exact, 0.015);
    }
}

TEST(LightShare, LightSizeIsContinuousDownToTheHardCentreMask) {
  const std::vector<V2f> places = placesOfRings(8);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-4, 4);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<float> s(9);
    for (float& v : s) v = value(random);
    if (std::fabs(s[0]) < 0.1f) s[0] = 0.1f;
    float before = LightShare(places, false, 0).of(s.data());
    EXPECT_EQ(before, s[0] > 0 ? 1.0f : 0.0f);
    for (int i = 1; i <= 1000; ++i) {
      const float now = LightShare(places, false, static_cast<float>(i) / 1000).of(s.data());
      EXPECT_LT(std::fabs(now - before), 0.05f);
      before = now;
    }
  }
}

}  // namespace
}  // namespace kagefude
