#include "passes/edges/stair_share.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

TEST(StairShare, NothingWhereTheRunDoesNotTurn) {
  EXPECT_EQ(stairShare({3, 0}, {4, 0}), 0);
  EXPECT_EQ(stairShare({3, -1}, {4, -1}), 0) << "the other row's pixels lose";
}

TEST(StairShare, ByHandAtFortyFiveDegrees) {
  // One pixel wide, from 1/2 above to 1/2 below: a triangle of base and height 1/2.
  EXPECT_DOUBLE_EQ(stairShare({0, 1}, {0, -1}), 0.125);
}

// A straight line of slope 1/n gives runs of n pixels; the shares of the two rows' pixels are the
// areas on its two sides.
TEST(StairShare, AStraightLinesAreasAreExact) {
  for (const int n : {1, 2, 3, 4, 7, 20})
    for (int i = 0; i < n; ++i) {
      const auto height = [&](double at) { return 0.5 - at / n; };
      const double from = height(i), to = height(i + 1);
      const double above = from <= 0 ? 0 : to >= 0 ? (from + to) / 2 : from * from * n / 2;
      EXPECT_NEAR(stairShare({i, 1}, {n - 1 - i, -1}), above, 1e-12) << n << " " << i;
    }
}

TEST(StairShare, MirrorsAndBends) {
  EXPECT_DOUBLE_EQ(stairShare({1, 1}, {3, -1}), stairShare({1, 1}, {3, 0}));
  EXPECT_DOUBLE_EQ(stairShare({1, 0}, {3, 1}), stairShare({3, 1}, {1, 0}));
  EXPECT_DOUBLE_EQ(stairShare({0, 1}, {0, 1}), 0.25) << "bent in the middle: two triangles";
}

}  // namespace
}  // namespace kagefude
