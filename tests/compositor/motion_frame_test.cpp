#include "compositor/motion_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace kagefude {
namespace {

constexpr int side = 16;

/// A skin that slid by two pixels to the right while its object's matrix stood still.
MotionFrame slid(float pixels) {
  MotionFrame frame;
  frame.ids = Labels(side, side, 5u);
  frame.position = Vec3Plane(side, side);
  frame.rest = Vec3Plane(side, side);
  frame.motionX = Floats(side, side, -2.0f);
  frame.motionY = Floats(side, side, 0.0f);
  frame.worldFromObject[5u] = Transform();
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const V3f seen(0.1f * static_cast<float>(x), 0.1f * static_cast<float>(y), 1);
      frame.position.set(x, y, seen);
      frame.rest.set(x, y, seen - V3f(0.1f * pixels, 0, 0));
    }
  return frame;
}

TEST(MotionFrame, SkinIsFollowedByItsRestPositions) {
  MotionFrame now = slid(2);
  const MotionFrame before = slid(0);
  const PreviousPlaces places = previousPlaces(now, before);
  EXPECT_EQ(places.pixels, (side - 3) * (side - 2));
  EXPECT_EQ(places.x(8, 8), 6.0f);
  now.rest = {};
  EXPECT_EQ(previousPlaces(now, before).pixels, 0) << "its matrix says that it stood still";
}

TEST(MotionFrame, SkinHiddenBehindTheSameObjectIsNotCompared) {
  const MotionFrame now = slid(2);
  MotionFrame before = slid(0);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < 7; ++x) before.rest.set(x, y, {9, 9, 9});
  const PreviousPlaces places = previousPlaces(now, before);
  EXPECT_TRUE(std::isnan(places.x(8, 8)));
  EXPECT_EQ(places.x(11, 8), 9.0f);
}

TEST(MotionFrame, PixelsWithoutRestAreLeftOutAndOtherObjectsGoByTheirMatrix) {
  MotionFrame now = slid(2);
  const MotionFrame before = slid(0);
  now.rest.x(8, 8) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(previousPlaces(now, before).x(8, 8)));
  // No rest at all in one frame: by the matrix, which moved the object by two pixels.
  now.rest = {};
  now.worldFromObject[5u].m[0][3] = 0.2;
  EXPECT_EQ(previousPlaces(now, before).pixels, (side - 3) * (side - 2));
  now.worldFromObject.clear();
  EXPECT_EQ(previousPlaces(now, before).pixels, (side - 3) * (side - 2)) << "by ids alone";
}

}  // namespace
}  // namespace kagefude
