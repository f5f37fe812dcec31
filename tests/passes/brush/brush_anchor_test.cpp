#include "passes/brush/brush_anchor.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

BrushSubject boxOf(const V3f& halfSize) {
  BrushSubject subject;
  subject.boundsMin = -halfSize;
  subject.boundsMax = halfSize;
  subject.hasBounds = true;
  return subject;
}

Light pointAt(const V3f& p) {
  Light light;
  light.position = p;
  return light;
}

TEST(BrushAnchor, ObjectsCentreIsTheReferencePoint) {
  BrushSubject subject = boxOf({1, 1, 1});
  subject.boundsMax = {3, 1, 1};
  subject.worldFromObject.m[2][3] = 5;
  const auto points = referencePoints(subject, pointAt({9, 9, 9}), {});
  ASSERT_EQ(points.size(), 2u) << "twice as long as wide";
  BrushParams one;
  one.points = 1;
  EXPECT_EQ(referencePoints(subject, pointAt({9, 9, 9}), one).at(0), V3f(1, 0, 5));
}

TEST(BrushAnchor, GroundTakesTheFootOfThePerpendicular) {
  BrushSubject ground = boxOf({10, 8, 0});
  ground.flat = true;
  ground.worldFromObject.m[2][3] = -1;
  const Light light = pointAt({3, 4, 6});
  const auto points = referencePoints(ground, light, {});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], V3f(3, 4, -1));
  EXPECT_EQ(makeBrushAnchor(ground, light, {}).points[0].frame.axis, V3f(0, 0, -1));
  Light sun;
  sun.type = Light::Type::sun;
  sun.direction = {0.8f, 0, -0.6f};
  EXPECT_EQ(referencePoints(ground, sun, {}).at(0), V3f(0, 0, -1));
  EXPECT_EQ(makeBrushAnchor(ground, sun, {}).points[0].frame.axis, V3f(0, 0, -1));
}

TEST(BrushAnchor, WallLitFromBehindTurnsItsAxisRound) {
  BrushSubject wall = boxOf({4, 0, 4});
  wall.flat = true;
  EXPECT_EQ(makeBrushAnchor(wall, pointAt({0, 5, 0}), {}).points[0].frame.axis, V3f(0, -1, 0));
  EXPECT_EQ(makeBrushAnchor(wall, pointAt({0, -5, 0}), {}).points[0].frame.axis, V3f(0, 1, 0));
}

TEST(BrushAnchor, LongObjectsGetSeveralPointsInOrder) {
  const BrushSubject rod = boxOf({0.5f, 0.5f, 2});
  const BrushAnchor anchor = makeBrushAnchor(rod, pointAt({5, 0, 0}), {});
  ASSERT_EQ(anchor.points.size(), 4u);
  EXPECT_FLOAT_EQ(anchor.points[0].position.z, -1.5f);
  EXPECT_FLOAT_EQ(anchor.points[3].position.z, 1.5f);
  for (size_t i = 1; i < 4; ++i) EXPECT_GT(anchor.points[i].along, anchor.points[i - 1].along);
}

TEST(BrushAnchor, GivenPointsAreTakenAndSorted) {
  BrushSubject subject = boxOf({1, 1, 1});
  subject.referencePoints = {{0, 0, 3}, {0, 0, 1}, {0, 0, 2}};
  const BrushAnchor anchor = makeBrushAnchor(subject, pointAt({5, 0, 0}), {});
  ASSERT_EQ(anchor.points.size(), 3u);
  EXPECT_NE(anchor.points[0].position.z, 2.0f);
  EXPECT_EQ(anchor.points[1].position.z, 2.0f);
}

TEST(BrushAnchor, MappingDistanceFollowsTheObject) {
  BrushSubject ball = boxOf({2, 2, 2});
  EXPECT_FLOAT_EQ(makeBrushAnchor(ball, {}, {}).mappingDistance, 0.5f);
  for (int i = 0; i < 3; ++i) ball.worldFromObject.m[i][i] = 3;
  EXPECT_FLOAT_EQ(makeBrushAnchor(ball, {}, {}).mappingDistance, 1.5f);
  BrushParams set;
  set.mappingDistance = 0.8f;
  EXPECT_FLOAT_EQ(makeBrushAnchor(ball, {}, set).mappingDistance, 0.8f);
  ball.mappingDistance = 0.3f;
  EXPECT_FLOAT_EQ(makeBrushAnchor(ball, {}, set).mappingDistance, 0.3f);
  BrushSubject ground = boxOf({100, 100, 0});
  ground.flat = true;
  ground.sceneRadius = 4;
  // A quarter of the scene's radius is 1; 25 / 32 is the nearest octave of the ground's own 25.
  EXPECT_FLOAT_EQ(makeBrushAnchor(ground, {}, {}).mappingDistance, 0.78125f);
  EXPECT_EQ(makeBrushAnchor(ground, {}, {}).coarser, 0.0f);
  EXPECT_FLOAT_EQ(makeBrushAnchor({}, {}, {}).mappingDistance, 1.0f) << "nothing is known";
}

TEST(BrushAnchor, GroundDoesNotSwimWhenTheScenesSizeChanges) {
  BrushSubject ground = boxOf({100, 100, 0});
  ground.flat = true;
  float size = 0;
  for (int i = 0; i <= 200; ++i) {
    ground.sceneRadius = 4 * exp2Of(static_cast<float>(i) / 100);
    const BrushAnchor anchor = makeBrushAnchor(ground, {}, {});
    const float octave = log2Of(anchor.mappingDistance / 25);
    ASSERT_NEAR(octave, std::round(octave), 1e-5) << "strokes slide within an octave";
    const float coarseness = octave + anchor.coarser;
    if (i > 0) {
      ASSERT_LT(std::fabs(coarseness - size), 0.06f) << i << ": one size fades into the next";
    }
    size = coarseness;
  }
}

TEST(BrushAnchor, ScreenSizeFollowsThePixelInOctaves) {
  BrushSubject ball = boxOf({2, 2, 2});
  BrushParams params;
  params.size = BrushParams::Size::screen;
  double before = 0;
  for (int i = 0; i <= 200; ++i) {
    // Zooming over a factor of 16.
    ball.worldPerPixel = 0.001f * exp2Of(static_cast<float>(i) / 50);
    const BrushAnchor anchor = makeBrushAnchor(ball, {}, params);
    const float wanted = 512 * ball.worldPerPixel / (2 * pi);
    const double octaves = log2Of(anchor.mappingDistance) + anchor.coarser;
    ASSERT_NEAR(octaves, log2Of(wanted), 1e-4);
    // Whole octaves of the object's own distance, so strokes stay where they are.
    const float whole = log2Of(anchor.mappingDistance / 0.5f);
    ASSERT_NEAR(whole, std::round(whole), 1e-5);
    if (i > 0) {
      ASSERT_LT(octaves - before, 0.03);
    }
    before = octaves;
  }
}

TEST(StrokeOctave, ChangesWithoutAStepAndStartsAtTheAnchorsOwn) {
  BrushAnchor anchor;
  anchor.mappingDistance = 0.25f;
  const StrokeOctave own = strokeOctave(anchor, 0);
  EXPECT_EQ(own.mappingDistance, anchor.mappingDistance);
  EXPECT_EQ(own.coarser, 0.0f);
  EXPECT_EQ(own.shift, anchor.shift);
  // Shares of the octaves by their own sizes: each rises to 1 and falls without a step.
  const auto shareOf = [&](float size, float stretched) {
    const StrokeOctave octave = strokeOctave(anchor, stretched);
    const float at = std::log2(octave.mappingDistance / anchor.mappingDistance);
    if (std::fabs(at - size) < 1e-3f) return 1 - octave.coarser;
    return std::fabs(at + 1 - size) < 1e-3f ? octave.coarser : 0.0f;
  };
  for (const float size : {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f}) {
    EXPECT_EQ(shareOf(size, -size), 1.0f) << size;
    float before = shareOf(size, -4);
    for (float stretched = -4; stretched < 4; stretched += 0.01f) {
      const float share = shareOf(size, stretched);
      EXPECT_LE(std::fabs(share - before), 0.0201f) << size << " at " << stretched;
      before = share;
    }
  }
}

}  // namespace
}  // namespace kagefude
