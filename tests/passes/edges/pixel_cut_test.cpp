#include "passes/edges/pixel_cut.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kagefude {
namespace {

TEST(PixelCut, NothingIsTakenByNoCutAndAllByOneThatCoversIt) {
  EXPECT_DOUBLE_EQ(PixelCut().area(), 1);
  PixelCut away, all;
  away.take({-2, 1, 0});
  EXPECT_DOUBLE_EQ(away.area(), 1);
  all.take({2, 1, 0});
  EXPECT_DOUBLE_EQ(all.area(), 0);
}

TEST(PixelCut, KnownAreas) {
  PixelCut half, corner, quarter;
  half.take({0, 1, 0});
  EXPECT_DOUBLE_EQ(half.area(), 0.5);
  corner.take({-0.5, 1, 1});  // the triangle x + y > 1/2 with legs of a half
  EXPECT_DOUBLE_EQ(corner.area(), 1 - 0.125);
  quarter.take({0, 1, 0});
  quarter.take({0, 0, 1});
  EXPECT_DOUBLE_EQ(quarter.area(), 0.25);
}

TEST(PixelCut, TheSameCutTwiceTakesNoMore) {
  PixelCut cut;
  cut.take({-0.1, 0.7, 0.3});
  const double once = cut.area();
  cut.take({-0.1, 0.7, 0.3});
  EXPECT_NEAR(cut.area(), once, 1e-12);
}

// Against counting a grid, for lines of every slope and place.
TEST(PixelCut, AgreesWithAFineGridAtEverySlope) {
  constexpr int fine = 400;
  for (double turn = 0; turn < 6.3; turn += 0.37)
    for (double off = -0.6; off <= 0.6; off += 0.15) {
      const HalfPlane first{off, std::cos(turn), std::sin(turn)};
      const HalfPlane second{off - 0.2, std::cos(2 * turn), std::sin(2 * turn)};
      PixelCut cut;
      cut.take(first);
      cut.take(second);
      int left = 0;
      for (int v = 0; v < fine; ++v)
        for (int u = 0; u < fine; ++u) {
          const double x = (u + 0.5) / fine - 0.5, y = (v + 0.5) / fine - 0.5;
          left += !(first.at(x, y) > 0) && !(second.at(x, y) > 0);
        }
      EXPECT_NEAR(cut.area(), static_cast<double>(left) / (fine * fine), 2.0 / fine);
    }
}

}  // namespace
}  // namespace kagefude
