#include "passes/measure/compare_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"

namespace kagefude {
namespace {

Floats row(std::initializer_list<float> values) {
  Floats plane(static_cast<int>(values.size()), 1);
  int x = 0;
  for (const float v : values) plane(x++, 0) = v;
  return plane;
}

TEST(ComparePlanes, HandValues) {
  const Floats truth = row({0, 0.5f, 0.5f, 1}), value = row({0.3f, 0.6f, 0.2f, 1});
  const PlaneDifference d = comparePlanes(value, truth, {}, 100);
  EXPECT_EQ(d.pixels, 4u);
  EXPECT_EQ(d.penumbraPixels, 2u);
  EXPECT_NEAR(d.rmse, std::sqrt((0.09 + 0.01 + 0.09) / 4), 1e-6);
  EXPECT_NEAR(d.penumbraRmse, std::sqrt(0.05), 1e-6);
  EXPECT_NEAR(d.penumbraBias, -0.1, 1e-6);
  EXPECT_NEAR(d.maximum, 0.3, 1e-6);
  EXPECT_NEAR(d.median, 0.1, 1e-6);
  EXPECT_NEAR(d.p99, 0.3, 1e-6);
  EXPECT_NEAR(d.truthNoise, 0.05, 1e-6);
}

TEST(ComparePlanes, NoPenumbraGivesZeros) {
  const Floats truth = row({0, 1});
  const PlaneDifference d = comparePlanes(truth, truth, {}, 512);
  EXPECT_EQ(d.penumbraPixels, 0u);
  EXPECT_EQ(d.penumbraRmse, 0);
  EXPECT_EQ(d.rmse, 0);
}

TEST(ComparePlanes, LeavesOutWhatIsNotFiniteAndNotAskedFor) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Floats truth = row({0.5f, 0.5f, 0.5f}), value = row({nan, 0.6f, 0}), where = row({1, 1, 0});
  const PlaneDifference d = comparePlanes(value, truth, where, 0);
  EXPECT_EQ(d.pixels, 1u);
  EXPECT_NEAR(d.maximum, 0.1, 1e-6);
  EXPECT_EQ(differencePicture(value, truth, where, 2)(2, 0), 0.5f);
}

TEST(ComparePlanes, RefusesOtherSizes) {
  EXPECT_THROW(comparePlanes(row({1}), row({1, 2}), {}, 0), InputError);
}

}  // namespace
}  // namespace kagefude
