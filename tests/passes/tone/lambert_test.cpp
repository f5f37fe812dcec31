#include "passes/tone/lambert.h"

#include <gtest/gtest.h>

#include <limits>

namespace kagefude {
namespace {

struct OnePixel {
  Vec3Plane normal{1, 1}, position{1, 1};
  Labels label{1, 1, 1u};

  OnePixel(const V3f& n, const V3f& p) {
    normal.set(0, 0, n);
    position.set(0, 0, p);
  }
  float shade(const Light& light, const LambertParams& params = {}) const {
    return lambertShade(normal, position, label, light, params)(0, 0);
  }
};

Light pointAt(const V3f& p) {
  Light light;
  light.position = p;
  return light;
}

TEST(Lambert, CosineByHand) {
  const OnePixel ground({0, 0, 1}, {1, 0, 0});
  EXPECT_FLOAT_EQ(ground.shade(pointAt({1, 0, 5})), 1.0f);
  EXPECT_FLOAT_EQ(ground.shade(pointAt({4, 0, 4})), 0.8f) << "3-4-5 triangle";
  EXPECT_EQ(ground.shade(pointAt({1, 0, -5})), 0.0f) << "behind the surface";
}

TEST(Lambert, SunUsesItsDirectionOnly) {
  Light sun = pointAt({1, 0, -100});
  sun.type = Light::Type::sun;
  sun.direction = {0.6f, 0, -0.8f};
  EXPECT_FLOAT_EQ(OnePixel({0, 0, 1}, {7, -3, 2}).shade(sun), 0.8f);
}

TEST(Lambert, LongNormalIsNotBrighter) {
  EXPECT_FLOAT_EQ(OnePixel({0, 0, 0.5f}, {0, 0, 0}).shade(pointAt({3, 0, 4})), 0.8f);
}

TEST(Lambert, WrapReachesBehindTheTerminator) {
  LambertParams half;
  half.wrap = 1;
  EXPECT_FLOAT_EQ(OnePixel({0, 0, 1}, {0, 0, 0}).shade(pointAt({5, 0, 0}), half), 0.5f);
}

TEST(Lambert, SpotFallsOffInItsBlendZone) {
  Light spot = pointAt({0, 0, 2});
  spot.type = Light::Type::spot;
  spot.direction = {0, 0, -1};
  spot.spotAngle = pi / 2;  // its cone meets z = 0 at radius 2
  EXPECT_EQ(spotFalloff(spot, {1.99f, 0, 0}), 1.0f);
  EXPECT_EQ(spotFalloff(spot, {2.01f, 0, 0}), 0.0f);
  EXPECT_EQ(spotFalloff(spot, {0, 0, 3}), 0.0f) << "behind the lamp";
  spot.spotBlend = 1;
  // The cosine midway between the edge's and the axis's: half of the light.
  const float cosine = 0.5f * (std::sqrt(0.5f) + 1.0f);
  const float across = 2 * std::sqrt(1 - cosine * cosine) / cosine;
  EXPECT_NEAR(spotFalloff(spot, {across, 0, 0}), 0.5f, 1e-4f);
}

TEST(Lambert, BackgroundAndBrokenPixelsAreBlack) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(OnePixel({nan, 0, 1}, {0, 0, 0}).shade(pointAt({0, 0, 1})), 0.0f);
  EXPECT_EQ(OnePixel({0, 0, 1}, {nan, 0, 0}).shade(pointAt({0, 0, 1})), 0.0f);
  EXPECT_EQ(OnePixel({0, 0, 0}, {0, 0, 0}).shade(pointAt({0, 0, 1})), 0.0f);
  EXPECT_EQ(OnePixel({0, 0, 1}, {0, 0, 1}).shade(pointAt({0, 0, 1})), 0.0f) << "at the light";
  OnePixel background({0, 0, 1}, {0, 0, 0});
  background.label.fill(0);
  EXPECT_EQ(background.shade(pointAt({0, 0, 1})), 0.0f);
}

}  // namespace
}  // namespace kagefude
