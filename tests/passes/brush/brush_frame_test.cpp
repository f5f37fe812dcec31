#include "passes/brush/brush_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "passes/brush/brush_angle.h"
#include "passes/brush/brush_repeat.h"

namespace kagefude {
namespace {

V3f onSphere(double azimuth, double height) {
  const double r = std::sqrt(1 - height * height);
  return V3f(static_cast<float>(r * std::cos(azimuth)), static_cast<float>(r * std::sin(azimuth)),
             static_cast<float>(height));
}

void expectOrthonormal(const BrushFrame& frame) {
  EXPECT_NEAR(frame.l1.dot(frame.l1), 1, 1e-5);
  EXPECT_NEAR(frame.l2.dot(frame.l2), 1, 1e-5);
  EXPECT_NEAR(frame.l1.dot(frame.l2), 0, 1e-5);
  EXPECT_NEAR(frame.l1.dot(frame.axis), 0, 1e-5);
  EXPECT_NEAR(frame.l2.dot(frame.axis), 0, 1e-5);
  EXPECT_NEAR(frame.l1.cross(frame.l2).dot(frame.axis), 1, 1e-5) << "right-handed";
}

TEST(BrushFrame, AxisRunsFromTheLightThroughTheReferencePoint) {
  Light light;
  light.position = {1, 2, 7};
  const V3f axis = lightAxis(light, {1, 2, 3});
  EXPECT_EQ(axis, V3f(0, 0, -1));
  EXPECT_EQ(lightAxis(light, light.position), V3f(0, 0, -1)) << "no distance: its direction";
  light.type = Light::Type::sun;
  light.direction = {0, 3, 4};
  EXPECT_NEAR((lightAxis(light, {9, 9, 9}) - V3f(0, 0.6f, 0.8f)).length(), 0, 1e-6);
}

TEST(BrushFrame, SeedFrameByHand) {
  // V along Z: no rotation at all.
  const BrushFrame straight = seedFrame({0, 0, 1});
  EXPECT_EQ(straight.l1, V3f(1, 0, 0));
  EXPECT_EQ(straight.l2, V3f(0, 1, 0));
  // V = (0.6, 0, 0.8): turned about Y by asin 0.6.
  const BrushFrame turned = seedFrame({0.6f, 0, 0.8f});
  EXPECT_NEAR((turned.l1 - V3f(0.8f, 0, -0.6f)).length(), 0, 1e-6);
  EXPECT_NEAR((turned.l2 - V3f(0, 1, 0)).length(), 0, 1e-6);
  // Out of every coordinate plane, where the seed's own matrix leaves V.
  expectOrthonormal(seedFrame(V3f(0.48f, 0.6f, 0.64f)));
  expectOrthonormal(seedFrame(V3f(1, 0, 0)));
}

TEST(BrushFrame, TurningFrameIsOrthonormalAllRound) {
  ObjectAxes tilted;
  tilted.x = V3f(0.36f, 0.48f, -0.8f);
  tilted.y = V3f(-0.8f, 0.6f, 0);
  tilted.z = tilted.x.cross(tilted.y);
  for (int i = 0; i < 60; ++i)
    for (int j = -19; j < 20; ++j)
      expectOrthonormal(turningFrame(onSphere(i * 0.105, j / 20.0), tilted));
  const BrushFrame above = turningFrame({0, 0, -1}, {});
  EXPECT_EQ(above.l1, V3f(1, 0, 0));
  EXPECT_EQ(above.l2, V3f(0, -1, 0));
  expectOrthonormal(turningFrame({0, 0, 1}, {}));
}

// Largest change of L1 over a full light orbit in steps of one degree.
template <class MakeFrame>
float largestStep(double height, double centreX, const MakeFrame& make) {
  float largest = 0;
  V3f before;
  for (int degree = 0; degree <= 360; ++degree) {
    const V3f light = onSphere(degree * M_PI / 180, height) + V3f(float(centreX), 0, 0);
    const BrushFrame frame = make((-light).normalized());
    if (degree > 0) largest = std::max(largest, (frame.l1 - before).length());
    before = frame.l1;
  }
  return largest;
}

TEST(BrushFrame, TurnsWithoutJumpsOverALightOrbit) {
  const auto turning = [](const V3f& axis) { return turningFrame(axis, {}); };
  for (const double height : {0.9, 0.5, 0.1, 0.0, -0.3})
    EXPECT_LT(largestStep(height, 0, turning), 0.05f) << height;
}

TEST(BrushFrame, SeedFrameJumpsWhereTheAxisPassesX) {
  EXPECT_GT(largestStep(0.0, 0, seedFrame), 1.0f);
  EXPECT_LT(largestStep(0.0, 0, [](const V3f& v) { return turningFrame(v, {}); }), 0.05f);
}

TEST(BrushFrame, TurnsWithTheObject) {
  Transform turned;  // a quarter turn about X, and a scale that must not matter
  turned.m[1][1] = turned.m[2][2] = 0;
  turned.m[1][2] = -3;
  turned.m[2][1] = 3;
  turned.m[0][0] = 2;
  const ObjectAxes axes = objectAxes(turned);
  EXPECT_NEAR((axes.y - V3f(0, 0, 1)).length(), 0, 1e-6);
  EXPECT_NEAR((axes.z - V3f(0, -1, 0)).length(), 0, 1e-6);
  const BrushFrame frame = turningFrame(-axes.z, axes);
  EXPECT_NEAR((frame.l1 - axes.x).length(), 0, 1e-6);
}

TEST(BrushFrame, CollapsedMatrixStillGivesAxes) {
  Transform flat;
  for (auto& row : flat.m)
    for (double& value : row) value = 0;
  flat.m[3][3] = 1;
  const ObjectAxes axes = objectAxes(flat);
  EXPECT_NEAR(axes.x.dot(axes.y), 0, 1e-6);
  EXPECT_NEAR(axes.z.length(), 1, 1e-6);
}

TEST(BrushAngle, QuadrantsByHand) {
  BrushFrame frame;  // l1 = X, l2 = Y: W counts from +Y towards +X
  EXPECT_EQ(brushAngle(frame, {0, 0, 0}, {0, 2, 5}), 0.0f);
  EXPECT_NEAR(brushAngle(frame, {0, 0, 0}, {2, 2, 0}), 0.125f, 1e-6f);
  EXPECT_EQ(brushAngle(frame, {0, 0, 0}, {2, 0, 0}), 0.25f) << "the seed sets this to 0";
  EXPECT_EQ(brushAngle(frame, {0, 0, 0}, {0, -2, 0}), 0.5f);
  EXPECT_EQ(brushAngle(frame, {1, 1, 1}, {-1, 1, 1}), 0.75f);
  EXPECT_EQ(brushAngle(frame, {1, 1, 1}, {1, 1, 9}), 0.0f) << "on the axis";
}

TEST(BrushAngle, GrowsEvenlyThroughEveryQuadrant) {
  float before = -1;
  for (int i = 0; i < 3600; ++i) {
    const double t = (i + 0.5) / 3600 * 2 * M_PI;
    const V3f p(static_cast<float>(std::sin(t)), static_cast<float>(std::cos(t)), 0);
    const float angle = brushAngle({}, {0, 0, 0}, p);
    ASSERT_NEAR(angle, (i + 0.5) / 3600, 2e-6);
    ASSERT_GT(angle, before);
    before = angle;
  }
}

TEST(BrushRepeat, RingsByHand) {
  const BrushRepeat inner = brushRepeat(0.3f, 0.5f, 0.5f);
  EXPECT_EQ(inner.count, 0.0f);
  EXPECT_FLOAT_EQ(inner.fraction, 0.6f);
  EXPECT_NEAR(inner.next, 0.2f, 1e-6f) << "(0.6 - 1) / 0.5 + 1";
  const BrushRepeat plain = brushRepeat(1.1f, 0.5f, 0.5f);
  EXPECT_EQ(plain.count, 2.0f);
  EXPECT_NEAR(plain.fraction, 0.2f, 1e-6f);
  EXPECT_EQ(plain.next, 0.0f);
  EXPECT_EQ(brushRepeat(0.999f, 1.0f, 0.0f).next, 0.0f) << "no blending asked for";
}

TEST(BrushRepeat, DistanceFromTheAxis) {
  EXPECT_FLOAT_EQ(axisDistance({}, {1, 1, 1}, {4, 5, 77}), 5.0f);
}

}  // namespace
}  // namespace kagefude
