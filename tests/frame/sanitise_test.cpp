#include "frame/sanitise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kagefude {
namespace {

TEST(ClearNonFinite, TurnsBadPixelsIntoBackgroundAndCountsThemOnce) {
  Vec3Plane position(3, 40), normal(3, 40);
  Labels labels(3, 40, 7);
  for (Floats* plane : {&position.x, &position.y, &position.z, &normal.x, &normal.y, &normal.z}) {
    plane->fill(1.0f);
  }
  position.y(0, 0) = NAN;
  normal.z(0, 0) = INFINITY;
  normal.x(2, 39) = -INFINITY;
  EXPECT_EQ(clearNonFinite(position, normal, labels), 2u);
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(2, 39)}) {
    EXPECT_EQ(position.view()(x, y), V3f(0, 0, 0));
    EXPECT_EQ(normal.view()(x, y), V3f(0, 0, 0));
    EXPECT_EQ(labels(x, y), 0u);
  }
  EXPECT_EQ(labels(1, 20), 7u);
  EXPECT_EQ(position.view()(1, 20), V3f(1, 1, 1));
}

TEST(ClearNoDepth, NaNAndMinusInfHoldNothingAndInfIsNothingHit) {
  Floats depth(3, 2, 5.0f);
  depth(0, 0) = NAN;
  depth(1, 1) = -INFINITY;
  depth(2, 1) = INFINITY;
  depth(1, 0) = -1.0f;
  EXPECT_EQ(clearNoDepth(depth.view()), 2u);
  EXPECT_EQ(depth(0, 0), 1e10f);
  EXPECT_EQ(depth(1, 1), 1e10f);
  EXPECT_EQ(depth(2, 1), INFINITY);
  EXPECT_EQ(depth(1, 0), -1.0f);
  EXPECT_EQ(clearNoDepth({}), 0u);
}

TEST(ClearNonFinite, WorksWithoutNormalsLabelsOrPixels) {
  Vec3Plane position(2, 1), none;
  position.x.fill(NAN);
  position.y.fill(0.0f);
  position.z.fill(0.0f);
  EXPECT_EQ(clearNonFinite(position, none), 2u);
  EXPECT_EQ(clearNonFinite(none, none), 0u);
}

TEST(ClearNonFinite, ReplacesInSinglePlanes) {
  Floats depth(2, 1, 3.0f);
  depth(1, 0) = NAN;
  EXPECT_EQ(clearNonFinite(depth, 1e10f), 1u);
  EXPECT_EQ(depth(1, 0), 1e10f);
  EXPECT_EQ(depth(0, 0), 3.0f);
}

}  // namespace
}  // namespace kagefude
