#include "passes/depth_map/light_points.h"

#include <gtest/gtest.h>

#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

float shown(const HiddenPoints& hidden) {
  return static_cast<float>(LightPoints::size - hidden.count()) / LightPoints::size;
}

TEST(LightPoints, NothingIsHiddenAtFirst) {
  EXPECT_EQ(shown({}), 1.0f);
  EXPECT_FALSE(HiddenPoints{}.all());
}

TEST(LightPoints, ARectangleRoundTheDiscHidesAll) {
  const LightPoints points;
  HiddenPoints hidden;
  points.hideRectangle(-1, 1, -5, 5, hidden);
  EXPECT_TRUE(hidden.all());
}

TEST(LightPoints, HalfPlanesHideTheirShareOfTheDisc) {
  const LightPoints points;
  for (float edge = -1.2f; edge <= 1.2f; edge += 0.1f) {
    HiddenPoints byX, byY;
    points.hideRectangle(-9, edge, -9, 9, byX);
    points.hideRectangle(-9, 9, -9, edge, byY);
    EXPECT_NEAR(shown(byX), discShare(-edge), 0.02f) << edge;
    EXPECT_NEAR(shown(byY), discShare(-edge), 0.02f) << edge;
  }
}

TEST(LightPoints, RectanglesBesideTheDiscHideNothing) {
  const LightPoints points;
  HiddenPoints hidden;
  points.hideRectangle(1.1f, 3, -1, 1, hidden);
  points.hideRectangle(-1, 1, -3, -1.1f, hidden);
  points.hideRectangle(0.2f, 0.2f, -1, 1, hidden);
  EXPECT_EQ(hidden.count(), 0);
}

TEST(LightPoints, WhatIsHiddenTwiceCountsOnce) {
  const LightPoints points;
  HiddenPoints once, twice;
  points.hideRectangle(-1, 0, -1, 1, once);
  points.hideRectangle(-1, 0, -1, 1, twice);
  points.hideRectangle(-0.7f, -0.1f, -0.5f, 0.5f, twice);
  EXPECT_EQ(once.count(), twice.count());
}

TEST(LightPoints, AHorizonHidesWhatLiesBelow) {
  const LightPoints points;
  HiddenPoints half, none, all;
  points.hideBelow(0, {0.3f, -0.4f}, half);
  points.hideBelow(0.6f, {0.3f, -0.4f}, none);
  points.hideBelow(-0.6f, {0.3f, -0.4f}, all);
  EXPECT_NEAR(shown(half), 0.5f, 0.02f);
  EXPECT_EQ(none.count(), 0);
  EXPECT_TRUE(all.all());
}

}  // namespace
}  // namespace kagefude
