#include "passes/ground/paper_deposit.h"

#include <gtest/gtest.h>

#include <limits>

namespace kagefude {
namespace {

PaperParams paper(float strength, float pressure, float byTone) {
  PaperParams params;
  params.strength = strength;
  params.pressure = pressure;
  params.byTone = byTone;
  return params;
}

TEST(PaperDeposit, HandValues) {
  // Half the paper is covered; the step runs from 1/4 to 3/4, half of it at 1/2.
  EXPECT_FLOAT_EQ(depositShare(0.25f, 0.5f, 0, paper(1, 0.5f, 0)), 0.0f);
  EXPECT_FLOAT_EQ(depositShare(0.5f, 0.5f, 0, paper(1, 0.5f, 0)), 0.5f);
  EXPECT_FLOAT_EQ(depositShare(0.75f, 0.5f, 0, paper(1, 0.5f, 0)), 1.0f);
  // Half the strength takes off half of it.
  EXPECT_FLOAT_EQ(depositShare(0.25f, 0.5f, 0, paper(0.5f, 0.5f, 0)), 0.5f);
}

TEST(PaperDeposit, WithoutPressureNothingSticksAndFullPressureReachesTheDeepestHollow) {
  for (const float height : {0.0f, 0.5f, 1.0f}) {
    EXPECT_EQ(depositShare(height, 0.5f, 0, paper(1, 0, 0)), 0.0f);
    EXPECT_EQ(depositShare(height, 0.5f, 0, paper(1, 1, 0)), 1.0f);
    EXPECT_EQ(depositShare(height, 0.5f, 0, paper(0, 0, 0)), 1.0f);
  }
}

TEST(PaperDeposit, DarkTonesPressHarder) {
  const PaperParams params = paper(1, 0.5f, 0.5f);
  EXPECT_GT(depositShare(0.4f, 0.0f, 0, params), depositShare(0.4f, 1.0f, 0, params));
  const PaperParams chalk = paper(1, 0.5f, -0.5f);
  EXPECT_LT(depositShare(0.4f, 0.0f, 0, chalk), depositShare(0.4f, 1.0f, 0, chalk));
  EXPECT_EQ(depositShare(0.4f, std::numeric_limits<float>::quiet_NaN(), 0, params),
            depositShare(0.4f, 0.0f, 0, params));
}

TEST(PaperDeposit, ThickStrokesFillDeeperHollows) {
  const PaperParams params = paper(1, 0.5f, 0);
  // A grain of 1 presses by a tenth harder: heights count 0.15 more.
  EXPECT_NEAR(depositShare(0.35f, 0.5f, 1, params), depositShare(0.5f, 0.5f, 0, params), 1e-6f);
}

TEST(PaperDeposit, PaintStaysAssociatedAndReliefKeepsAlpha) {
  Floats r(2, 1, 0.8f), g(2, 1, 0.4f), b(2, 1, 0.2f), a(2, 1, 0.8f), tone(2, 1, 0.5f), height(2, 1);
  height(0, 0) = 0.5f;
  height(1, 0) = 1.0f;
  const PaintViews paint{r, g, b, a};
  const PaperSurface surface(PaperTooth{std::move(height), Floats(2, 1, 0.0f)});
  depositPaint(paint, tone, {}, surface, paper(1, 0.5f, 0));
  EXPECT_FLOAT_EQ(r(0, 0), 0.4f);
  EXPECT_FLOAT_EQ(a(0, 0), 0.4f);
  EXPECT_FLOAT_EQ(g(1, 0), 0.4f);
  EXPECT_FLOAT_EQ(a(1, 0), 0.8f);
  Floats slope(2, 1, 1.0f);
  PaperParams params;
  params.relief = 0.5f;
  shadeRelief(paint, slope, params);
  EXPECT_FLOAT_EQ(r(0, 0), 0.4f * 1.1f);
  EXPECT_FLOAT_EQ(a(0, 0), 0.4f);
}

}  // namespace
}  // namespace kagefude
