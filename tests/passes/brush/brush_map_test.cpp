#include "passes/brush/brush_map.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "passes/brush/brush_scene.h"

namespace kagefude {
namespace {

using test::BrushScene;
using test::everyMapping;
using test::mappingOf;
using test::oneStrip;
using test::sameBits;

TEST(BrushMap, SeedFormulasInDoublePrecision) {
  const BrushScene scene = test::ground(64, 3.0f);
  const auto strips = oneStrip(test::waveStrip(512, 4));
  const BrushAnchor anchor = test::straightAnchor(0.7f);
  const BrushParams params = mappingOf(BrushParams::Mapping::seed);
  const BrushResult result = scene.paint(std::span(&anchor, 1), strips, params);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const V3f p = Vec3View(scene.position)(x, y);
      const double angle = std::atan2(double(p.x), double(-p.y)) / (2 * M_PI);
      const double rings = std::hypot(double(p.x), double(p.y)) / double(0.7f);
      const double count = std::floor(rings), s = rings - count;
      const double t = s < 0.5 ? 0 : (s - 1) / 0.5 + 1;
      const double first = 0.5 + 0.25 * std::cos(2 * M_PI * angle * count);
      const double second = 0.5 + 0.25 * std::cos(2 * M_PI * angle * (count + 1));
      ASSERT_NEAR(result.r(x, y), first * (1 - t) + second * t, 2e-4) << x << "," << y;
    }
}

TEST(BrushMap, SeedReadsTheLeftEdgeOnlyRoundTheAxis) {
  const BrushScene scene = test::ground(32, 0.3f);
  const auto strips = oneStrip(test::waveStrip(64, 4));
  const BrushAnchor anchor = test::straightAnchor(1.0f);
  const BrushResult result =
      scene.paint(std::span(&anchor, 1), strips, mappingOf(BrushParams::Mapping::seed));
  for (int i = 0; i < 32; ++i) ASSERT_EQ(result.r(i, 7), result.r(0, 0));
}

TEST(BrushMap, HeldStrokesRunAlongTheObjectsAxes) {
  // Far out on the Y axis circles run along X, so u = x / (2π Md) alone.
  BrushScene scene = test::ground(64, 1.0f);
  const auto strips = oneStrip(test::waveStrip(512, 4));
  BrushAnchor anchor = test::straightAnchor(0.25f);
  anchor.points[0].position = {0, 50, 0};
  BrushParams params;
  params.grain = BrushParams::Grain::tone;
  const BrushResult result = scene.paint(std::span(&anchor, 1), strips, params);
  for (int x = 0; x < 64; ++x) {
    const double u = Vec3View(scene.position)(x, 9).x / (2 * M_PI * 0.25);
    ASSERT_NEAR(result.r(x, 9), 0.5 + 0.25 * std::cos(2 * M_PI * u), 2e-3) << x;
  }
}

TEST(BrushMap, HeldStrokesStayWhenTheLightMovesAlongTheCircle) {
  const BrushScene scene = test::ground(64, 1.0f);
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  BrushAnchor before = test::straightAnchor(0.25f), after = before;
  before.points[0].position = {0, 50, 0};
  after.points[0].position = {3, 50, 0};
  const BrushResult a = scene.paint(std::span(&before, 1), strips, {});
  const BrushResult b = scene.paint(std::span(&after, 1), strips, {});
  EXPECT_TRUE(sameBits(a.r, b.r));
}

TEST(BrushMap, HeldStrokesTurnWithTheObject) {
  BrushScene scene = test::ground(32, 1.0f);
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  Light light;
  light.position = {0, 0, 5};
  BrushSubject subject;
  const BrushAnchor still = makeBrushAnchor(subject, light, {});
  const BrushResult a = scene.paint(std::span(&still, 1), strips, {});
  // A quarter turn about Z and a move, of object, surface and light alike.
  subject.worldFromObject.m[0][0] = subject.worldFromObject.m[1][1] = 0;
  subject.worldFromObject.m[0][1] = -1;
  subject.worldFromObject.m[1][0] = 1;
  subject.worldFromObject.m[0][3] = 2;
  light.position = {2, 0, 5};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const V3f p = Vec3View(scene.position)(x, y);
      scene.position.set(x, y, {2 - p.y, p.x, 0});
    }
  const BrushAnchor turned = makeBrushAnchor(subject, light, {});
  const BrushResult b = scene.paint(std::span(&turned, 1), strips, {});
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) ASSERT_NEAR(a.r(x, y), b.r(x, y), 2e-3) << x << "," << y;
}

// Largest step between neighbours along the columns, inside and outside the wrap's columns.
TEST(BrushMap, PolarStrokesHaveNoSeamAtTheWrap) {
  const BrushScene scene = test::ground(256, 4.0f);
  const auto strips = oneStrip(test::waveStrip(256, 8));
  const BrushAnchor anchor = test::straightAnchor(0.8f);
  const BrushResult result =
      scene.paint(std::span(&anchor, 1), strips, mappingOf(BrushParams::Mapping::polar));
  // W counts from -Y, so it wraps between columns 127 and 128 below the middle. There u and 1 - u
  // lie side by side: red is even in u and must be equal, as it is above, where W = 1/2.
  for (int y = 150; y < 256; ++y)
    ASSERT_NEAR(result.r(127, y), result.r(128, y), 1e-4) << "wrap, row " << y;
  for (int y = 0; y < 100; ++y)
    ASSERT_NEAR(result.r(127, y), result.r(128, y), 1e-4) << "opposite, row " << y;
  // Green is odd in u: a footprint that took the wrap for a jump would have washed it out.
  float green = 0;
  for (int y = 150; y < 256; ++y) green = std::max(green, std::fabs(result.g(130, y) - 0.5f));
  EXPECT_GT(green, 0.01f);
  for (int y = 150; y < 256; ++y)
    ASSERT_NEAR(result.g(127, y) + result.g(128, y), 1.0f, 1e-3f) << y;
}

TEST(BrushMap, PolarStrokesFadeInRoundTheAxis) {
  const BrushScene scene = test::ground(129, 1.0f);
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchor = test::straightAnchor(0.8f);
  const BrushResult result =
      scene.paint(std::span(&anchor, 1), strips, mappingOf(BrushParams::Mapping::polar));
  const float mean = stripRowMean(strips[0], 0.5f)[0];
  EXPECT_NEAR(result.r(64, 64), mean, 1e-5);
  EXPECT_NEAR(result.r(66, 64), mean, 0.03);
}

double deviation(const Floats& values, int first, int end) {
  double mean = 0, squares = 0;
  const int count = (end - first) * values.height();
  for (int y = 0; y < values.height(); ++y)
    for (int x = first; x < end; ++x) {
      mean += values(x, y) / count;
      squares += static_cast<double>(values(x, y)) * values(x, y) / count;
    }
  return std::sqrt(squares - mean * mean);
}

// Contrast of smooth noise on the ground at one octave share, relative to none.
double contrastAt(float coarser, BrushParams::CrossFade fade) {
  Floats values(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      values(x, y) = strokeNoise(9, static_cast<float>(x) * 0.5f, static_cast<float>(y) * 0.5f);
  const auto strips = oneStrip(makeStrip(values, values, values));
  BrushScene scene = test::ground(256, 10.0f);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) scene.tone(x, y) = (static_cast<float>(y) + 0.5f) / 256;
  BrushAnchor anchor = test::straightAnchor(1.0f);
  anchor.points[0].position = {0, 1e6f, 0};
  BrushParams params;
  params.crossFade = fade;
  const BrushResult plain = scene.paint(std::span(&anchor, 1), strips, params);
  anchor.coarser = coarser;
  anchor.coarserShift = 0.618f;
  const BrushResult mixed = scene.paint(std::span(&anchor, 1), strips, params);
  return deviation(mixed.r, 0, 256) / deviation(plain.r, 0, 256);
}

TEST(BrushMap, CrossFadeKeepsTheContrast) {
  for (const float coarser : {0.01f, 0.25f, 0.5f, 0.75f, 0.99f}) {
    EXPECT_NEAR(contrastAt(coarser, BrushParams::CrossFade::variance), 1.0, 0.15) << coarser;
  }
  EXPECT_LT(contrastAt(0.5f, BrushParams::CrossFade::linear), 0.85);
}

TEST(BrushMap, OctavesMeetWithoutAJump) {
  const BrushScene scene = test::ground(64, 2.0f);
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  for (const auto mapping : {BrushParams::Mapping::held, BrushParams::Mapping::polar}) {
    BrushAnchor end = test::straightAnchor(0.3f), start = test::straightAnchor(0.6f);
    end.coarser = 0.99999f;
    const BrushResult a = scene.paint(std::span(&end, 1), strips, mappingOf(mapping));
    const BrushResult b = scene.paint(std::span(&start, 1), strips, mappingOf(mapping));
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) ASSERT_NEAR(a.r(x, y), b.r(x, y), 1e-3) << x << "," << y;
  }
}

TEST(BrushMap, ReferencePointsHandOverSmoothly) {
  BrushScene scene = test::ground(400, 2.0f);
  const auto strips = oneStrip(test::waveStrip(256, 4));
  BrushAnchor anchor = test::straightAnchor(0.5f);
  anchor.points.push_back(anchor.points[0]);
  anchor.points[0].position.x = anchor.points[0].along = -1;
  anchor.points[1].position.x = anchor.points[1].along = 1;
  for (const auto mapping : {BrushParams::Mapping::held, BrushParams::Mapping::polar}) {
    const BrushResult result = scene.paint(std::span(&anchor, 1), strips, mappingOf(mapping));
    for (int x = 1; x < 400; ++x)
      ASSERT_LT(std::fabs(result.r(x, 90) - result.r(x - 1, 90)), 0.03f) << x;
  }
}

TEST(BrushMap, NothingIsDrawnOffTheAnchors) {
  BrushScene scene = test::ground(8, 1.0f);
  scene.index(1, 1) = 0;
  scene.index(2, 2) = 7;
  scene.position.set(3, 3, {std::numeric_limits<float>::quiet_NaN(), 0, 0});
  scene.tone(4, 4) = std::numeric_limits<float>::quiet_NaN();
  const auto strips = oneStrip(test::noiseStrip(16, 16));
  const BrushAnchor anchor = test::straightAnchor(0.2f);
  for (const auto mapping : everyMapping) {
    BrushParams params = mappingOf(mapping);
    params.diagnostics = true;
    const BrushResult result = scene.paint(std::span(&anchor, 1), strips, params);
    for (int i = 1; i <= 3; ++i) {
      EXPECT_EQ(result.r(i, i), 0.0f);
      EXPECT_EQ(result.a(i, i), 0.0f);
      EXPECT_EQ(result.angle(i, i), 0.0f);
    }
    EXPECT_EQ(result.a(4, 4), 1.0f) << "a NaN tone is black paint, not a hole";
    EXPECT_EQ(result.a(2, 3), 1.0f) << "beside the broken pixel";
    EXPECT_FALSE(std::isnan(result.r(2, 3)));
  }
}

TEST(BrushMap, DiagnosticsAreAngleAndRepeats) {
  const BrushScene scene = test::ground(4, 2.0f);
  const auto strips = oneStrip(test::noiseStrip(16, 16));
  const BrushAnchor anchor = test::straightAnchor(0.5f);
  BrushParams params;
  params.diagnostics = true;
  const BrushResult result = scene.paint(std::span(&anchor, 1), strips, params);
  // Pixel (3, 0) lies at (1.5, 1.5): from -Y towards +X, 135 degrees.
  EXPECT_NEAR(result.angle(3, 0), 0.375f, 1e-6f);
  EXPECT_NEAR(result.repeat(3, 0), std::sqrt(4.5f) / 0.5f, 1e-5f);
}

TEST(BrushMap, SeveralCallsFillOnePicture) {
  BrushScene scene = test::ground(8, 1.0f);
  const auto strips = oneStrip(test::noiseStrip(16, 16));
  const BrushAnchor anchor = test::straightAnchor(0.2f);
  const BrushResult whole = scene.paint(std::span(&anchor, 1), strips, {});
  BrushResult result;
  for (int half = 0; half < 2; ++half) {
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) scene.index(x, y) = (y < 4) == (half == 0) ? 1 : 0;
    applyBrush(scene.position, scene.normal, scene.tone, scene.index, std::span(&anchor, 1), strips,
               {}, result, half > 0);
  }
  // Footprints end at the border between the halves, where rows may differ a little.
  for (const int y : {0, 1, 2, 5, 6, 7})
    for (int x = 0; x < 8; ++x) ASSERT_EQ(result.r(x, y), whole.r(x, y)) << x << "," << y;
}

TEST(BrushMap, RefusesAnchorsThatCannotBeDrawn) {
  const BrushScene scene = test::ground(4, 1.0f);
  const auto strips = oneStrip(test::noiseStrip(16, 16));
  BrushAnchor anchor = test::straightAnchor(0.5f);
  anchor.strip = 1;
  EXPECT_THROW(scene.paint(std::span(&anchor, 1), strips, {}), InputError);
  anchor.strip = 0;
  anchor.mappingDistance = 0;
  EXPECT_THROW(scene.paint(std::span(&anchor, 1), strips, {}), InputError);
}

}  // namespace
}  // namespace kagefude
