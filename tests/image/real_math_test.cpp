#include "image/real_math.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

TEST(RealMath, TurnsMatchAtan2AllRound) {
  for (int i = 0; i < 100000; ++i) {
    const double angle = i * 1e-5;
    const double radius = 0.001 + (i % 97);
    const float x = static_cast<float>(radius * std::cos(2 * M_PI * angle));
    const float y = static_cast<float>(radius * std::sin(2 * M_PI * angle));
    double expected = std::atan2(double(y), double(x)) / (2 * M_PI);
    if (expected < 0) expected += 1;
    double error = std::fabs(turnsOf(y, x) - expected);
    error = std::min(error, 1 - error);
    ASSERT_LT(error, 1e-6) << angle;
  }
}

TEST(RealMath, TurnsOnTheAxesAndAtTheOrigin) {
  EXPECT_EQ(turnsOf(0, 1), 0.0f);
  EXPECT_EQ(turnsOf(1, 0), 0.25f);
  EXPECT_EQ(turnsOf(0, -1), 0.5f);
  EXPECT_EQ(turnsOf(-1, 0), 0.75f);
  EXPECT_EQ(turnsOf(0, 0), 0.0f);
  EXPECT_LT(turnsOf(-1e-30f, 1), 1.0f) << "just below the wrap must stay inside [0, 1)";
}

TEST(RealMath, SinCosOverSeveralTurns) {
  for (int i = -5000; i < 5000; ++i) {
    const float turns = static_cast<float>(i) * 7.3e-4f;
    const SinCos value = sinCosTurns(turns);
    ASSERT_NEAR(value.sin, std::sin(2 * M_PI * double(turns)), 1e-6);
    ASSERT_NEAR(value.cos, std::cos(2 * M_PI * double(turns)), 1e-6);
  }
}

TEST(RealMath, LogExpPower) {
  for (int i = 1; i < 20000; ++i) {
    const float v = static_cast<float>(i) * 1.7e-3f;
    ASSERT_NEAR(log2Of(v), std::log2(double(v)), 2e-6);
    const float x = static_cast<float>(i - 10000) * 1e-3f;
    ASSERT_NEAR(exp2Of(x) / std::exp2(double(x)), 1.0, 1e-6);
  }
  EXPECT_EQ(powerOf(0, 2.2f), 0.0f);
  EXPECT_NEAR(powerOf(0.5f, 2.2f), std::pow(0.5, 2.2), 1e-6);
  EXPECT_EQ(powerOf(1, 3), 1.0f);
}

}  // namespace
}  // namespace kagefude
