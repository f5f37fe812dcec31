#include "passes/casters/texture_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kagefude {
namespace {

/// Pixel (i, j) of a map of the ground: x = (i - 10)/5, y = (10 - j)/5, height 0.
struct GroundMap {
  Vec3Plane position{21, 21};
  Labels ids{21, 21, 1u};
  GroundMap() {
    for (int y = 0; y < 21; ++y)
      for (int x = 0; x < 21; ++x) position.set(x, y, {float(x - 10) / 5, float(10 - y) / 5, 0});
  }
};

TEST(TextureShadow, PlaceUnderATurnedAndScaledObjectByHand) {
  Transform turned;  // a quarter turn about z, twice as large, at (3, 4, 5)
  const double rows[4][4] = {{0, -2, 0, 3}, {2, 0, 0, 4}, {0, 0, 2, 5}, {0, 0, 0, 1}};
  std::copy(&rows[0][0], &rows[0][0] + 16, &turned.m[0][0]);
  const BlobPlace place =
      blobUnder(turned, {-1, -0.5, -1}, {1, 0.5, 1}, {0, 0, 1}, 0.25, {.width = 1, .length = 1});
  EXPECT_NEAR((place.centre - V3d(3, 4, 0.25)).length(), 0, 1e-12);
  EXPECT_NEAR((place.across - V3d(0, 1, 0)).length(), 0, 1e-6);
  EXPECT_NEAR((place.along - V3d(-1, 0, 0)).length(), 0, 1e-6);
  EXPECT_NEAR(place.width, 4, 1e-12);
  EXPECT_NEAR(place.length, 2, 1e-12);
}

TEST(TextureShadow, HeadingTurnsTheBlob) {
  const BlobPlace place = blobUnder(Transform(), V3d(-1), V3d(1), {0, 0, 1}, 0, {.heading = 0.25f});
  EXPECT_NEAR((place.across - V3d(0, 1, 0)).length(), 0, 1e-6);
}

TEST(TextureShadow, DarkestInTheMiddleNothingOutside) {
  const GroundMap map;
  const std::vector<BlobPlace> places = {BlobPlace()};
  const Floats tone = blobTone(map.position, map.ids, places, {}, {}, {.strength = 0.6f});
  EXPECT_FLOAT_EQ(tone(10, 10), 0.4f);
  EXPECT_EQ(tone(13, 10), 1.0f);
  EXPECT_GT(tone(11, 10), tone(10, 10));
  EXPECT_EQ(tone(11, 10), tone(9, 10)) << "round";
}

TEST(TextureShadow, MultiplyLeavesMoreLight) {
  const GroundMap map;
  const std::vector<BlobPlace> places = {BlobPlace()};
  const Floats light = blobTone(map.position, map.ids, places, {}, {},
                                {.strength = 0.6f, .blend = BlobBlend::multiply});
  EXPECT_FLOAT_EQ(light(10, 10), 0.4f * 0.6f + 0.4f);
  EXPECT_EQ(light(13, 10), 1.0f);
}

TEST(TextureShadow, BlobsThatMeetDoNotDarkenTwice) {
  const GroundMap map;
  const std::vector<BlobPlace> one = {BlobPlace()}, twice = {BlobPlace(), BlobPlace()};
  const Floats once = blobTone(map.position, map.ids, one, {}, {}, {});
  const Floats both = blobTone(map.position, map.ids, twice, {}, {}, {});
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 21; ++x) ASSERT_EQ(once(x, y), both(x, y));
}

TEST(TextureShadow, PictureIsReadUpright) {
  const GroundMap map;
  Floats picture(2, 2, 1.0f);
  picture(1, 0) = 0;  // top right: +x, +y
  BlobPlace place;
  place.width = place.length = 4;
  const std::vector<BlobPlace> places = {place};
  const Floats tone = blobTone(map.position, map.ids, places, {}, picture, {.strength = 1});
  EXPECT_FLOAT_EQ(tone(15, 5), 0.0f);  // (1, 1): the texel's centre
  EXPECT_FLOAT_EQ(tone(5, 5), 1.0f);
  EXPECT_FLOAT_EQ(tone(15, 15), 1.0f);
  EXPECT_FLOAT_EQ(tone(10, 10), 0.75f);
}

TEST(TextureShadow, LeavesOutOwnerHighSurfacesBackgroundAndNaN) {
  GroundMap map;
  map.ids(10, 10) = 0;
  map.ids(10, 9) = 5;
  map.position.z(10, 11) = 1;
  map.position.x(9, 10) = std::numeric_limits<float>::quiet_NaN();
  const std::vector<BlobPlace> places = {BlobPlace()};
  const std::vector<uint32_t> own = {5};
  const Floats tone = blobTone(map.position, map.ids, places, own, {}, {});
  for (const auto& [x, y] : {std::pair(10, 10), {10, 9}, {10, 11}, {9, 10}})
    EXPECT_EQ(tone(x, y), 1.0f) << x << ' ' << y;
  EXPECT_LT(tone(11, 10), 1.0f);
}

TEST(TextureShadow, BothBlendsByHand) {
  EXPECT_FLOAT_EQ(blendBlob(0.8f, 0.25f, BlobBlend::alpha), 0.8f * 0.25f);
  EXPECT_FLOAT_EQ(blendBlob(0.8f, 0.25f, BlobBlend::multiply), 0.25f * 0.75f + 0.8f * 0.25f);
  for (const BlobBlend blend : {BlobBlend::alpha, BlobBlend::multiply}) {
    EXPECT_EQ(blendBlob(0.8f, 1, blend), 0.8f);
    EXPECT_EQ(blendBlob(0.8f, 0, blend), 0.0f);
  }
}

}  // namespace
}  // namespace kagefude
