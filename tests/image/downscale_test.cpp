#include "image/downscale.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

TEST(Downscale, WindowsFallOnTheSameSmallerPixels) {
  const auto small = [](Window large, int scale) { return Downscale(large, scale).window(); };
  EXPECT_EQ(small({0, 0, 8, 6}, 2), (Window{0, 0, 4, 3}));
  EXPECT_EQ(small({3, -3, 4, 5}, 2), (Window{1, -2, 3, 3}));
  EXPECT_EQ(small({-8, 4, 4, 4}, 4), (Window{-2, 1, 1, 1}));
  EXPECT_EQ(small({-5, 7, 11, 1}, 1), (Window{-5, 7, 11, 1}));
}

TEST(Downscale, MeansAndSharesByHand) {
  Floats plane(3, 2);
  const float values[] = {1, 2, 3, 5, 7, 11};
  for (size_t i = 0; i < 6; ++i) plane.view().data[i] = values[i];
  const Downscale squares({1, 0, 3, 2}, 2);  // columns 1 | 2, 3
  ASSERT_EQ(squares.window(), (Window{0, 0, 2, 1}));
  const Floats mean = squares.mean(plane), share = squares.share(plane);
  EXPECT_EQ(mean(0, 0), 3);
  EXPECT_EQ(mean(1, 0), 5.75f);
  EXPECT_EQ(share(0, 0), 1.5f);
  EXPECT_EQ(share(1, 0), 5.75f);
}

TEST(Downscale, TheCommonestLabelNearestToTheMiddleStands) {
  const uint32_t ids[] = {7, 7, 7, 2, 2, 2, 7, 2, 5, 5, 2, 2, 5, 5, 5, 5};
  Labels labels(4, 4);
  for (size_t i = 0; i < 16; ++i) labels.view().data[i] = ids[i];
  const Labels four = Downscale({0, 0, 4, 4}, 4).standing(labels);
  EXPECT_EQ(four(0, 0), 5u);  // 2 and 5 six times each: the least, at (1, 1)
  const Downscale two({0, 0, 4, 4}, 2);
  const Labels places = two.standing(labels);
  const Labels picked = two.pick<uint32_t>(labels, places);
  EXPECT_EQ(picked(0, 0), 2u);  // two of each: the least
  EXPECT_EQ(picked(1, 0), 2u);
  EXPECT_EQ(picked(0, 1), 5u);
  EXPECT_EQ(picked(1, 1), 2u);
  EXPECT_EQ(places(0, 0), 4u);
}

}  // namespace
}  // namespace kagefude
