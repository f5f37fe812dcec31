#include "passes/measure/warp_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace kagefude {
namespace {

struct Pair {
  Floats now{16, 16}, before{16, 16};
  Labels ids{16, 16, 1u}, idsBefore{16, 16, 1u};
  Floats motionX{16, 16, 0.0f}, motionY{16, 16, 0.0f};

  WarpError measure() const {
    const View<const float> current[] = {now.view()}, previous[] = {before.view()};
    return warpError(current, previous,
                     findPreviousPlaces({ids, idsBefore, motionX, motionY, {}, {}, {}}));
  }
};

float ramp(float x, float y) { return 0.03f * x + 0.01f * y; }

TEST(WarpError, PictureThatMovesWithItsMotionHasNone) {
  Pair pair;
  // Moved right by 1.5 and up by 2 pixels since the previous frame.
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const float fx = static_cast<float>(x), fy = static_cast<float>(y);
      pair.before(x, y) = ramp(fx, fy);
      pair.now(x, y) = ramp(fx - 1.5f, fy + 2);
      pair.motionX(x, y) = -1.5f;
      pair.motionY(x, y) = -2;  // upward, as Blender counts
    }
  const WarpError error = pair.measure();
  EXPECT_LT(error.rmse, 1e-6);
  EXPECT_EQ(error.pixels, 13 * 13) << "the border, and a column and a row from outside";
  EXPECT_EQ(error.perPixel(0, 8), -1.0f);
}

TEST(WarpError, ConstantDifferenceByHand) {
  Pair pair;
  pair.now.fill(0.75f);
  pair.before.fill(0.5f);
  const WarpError error = pair.measure();
  EXPECT_DOUBLE_EQ(error.rmse, 0.25);
  EXPECT_EQ(error.pixels, 196) << "all but the border";
  EXPECT_FLOAT_EQ(error.perPixel(3, 3), 0.25f);
}

TEST(WarpError, OcclusionsBackgroundAndBrokenPixelsAreLeftOut) {
  Pair pair;
  pair.now.fill(1);
  pair.before.fill(1);
  pair.ids(2, 2) = 0;
  pair.idsBefore(5, 5) = 9;
  pair.motionX(8, 8) = std::numeric_limits<float>::quiet_NaN();
  pair.before(11, 11) = std::numeric_limits<float>::infinity();
  const WarpError error = pair.measure();
  EXPECT_EQ(error.pixels, 184) << "with the background's eight neighbours";
  EXPECT_EQ(error.rmse, 0.0);
  for (const int i : {2, 5, 8, 11}) EXPECT_EQ(error.perPixel(i, i), -1.0f) << i;
}

TEST(WarpError, FineWavesAreReadWithoutBlur) {
  Pair pair;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      pair.before(x, y) = std::sin(0.5f * static_cast<float>(x));
      pair.now(x, y) = std::sin(0.5f * (static_cast<float>(x) + 0.5f));
      pair.motionX(x, y) = 0.5f;
    }
  // Halfway between pixels, bilinear reading would lose 1 - cos 0.25 = 3 % of the wave.
  EXPECT_LT(pair.measure().rmse, 0.01);
}

TEST(WarpError, WhatAPartOfTheSameObjectHidIsLeftOut) {
  Pair pair;
  pair.now.fill(1);
  pair.before.fill(1);
  Vec3Plane position(16, 16), before(16, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      position.set(x, y, {static_cast<float>(x), static_cast<float>(y), 0});
      // In the previous frame a part stood before columns 6 to 8, nearer to the eye.
      before.set(x, y, {static_cast<float>(x), static_cast<float>(y), x >= 6 && x <= 8 ? 5.0f : 0});
    }
  const PreviousPlaces places = findPreviousPlaces(
      {pair.ids, pair.idsBefore, pair.motionX, pair.motionY, position, position, before});
  EXPECT_EQ(places.pixels, 14 * 11);
  EXPECT_TRUE(std::isnan(places.x(7, 7)));
  EXPECT_FALSE(std::isnan(places.x(9, 7)));
}

TEST(WarpError, NothingVisibleGivesZeroPixels) {
  Pair pair;
  pair.now.fill(1);
  pair.before.fill(0);
  pair.motionX.fill(100);
  const WarpError error = pair.measure();
  EXPECT_EQ(error.pixels, 0);
  EXPECT_EQ(error.rmse, 0.0);
}

}  // namespace
}  // namespace kagefude
