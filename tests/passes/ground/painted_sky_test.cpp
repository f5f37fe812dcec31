#include "passes/ground/painted_sky.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "passes/ground/fitted_picture.h"
#include "passes/ground/view_angles.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

Strip softStrip() {
  const PaintedStrip picture = paintStrip(stripPreset("soft"));
  return makeStrip(picture.r, picture.g, picture.b);
}

/// Looks along +Y, 90 degrees wide, Z up.
CameraRays levelCamera(int width, int height) {
  CameraRays rays;
  const double step = 2.0 / width;
  rays.directionX = V3d(step, 0, 0);
  rays.directionY = V3d(0, 0, -step);
  rays.direction0 = V3d(-1, 1, step * height / 2);
  return rays;
}

SkyView viewOf(int width, int height, const CameraRays* rays = nullptr) {
  SkyView view{width, height, 0, 0, width, height};
  view.rays = rays;
  return view;
}

TEST(ViewAngles, HandValues) {
  EXPECT_NEAR(viewAngles({0, 2, 0}, false).round, 0.25f, 1e-6f);
  EXPECT_NEAR(viewAngles({1, 0, 1}, false).above, 0.125f, 1e-6f);
  EXPECT_NEAR(viewAngles({0, 0, -3}, false).above, -0.25f, 1e-6f);
  EXPECT_NEAR(viewAngles({1, 1, 0}, true).above, 0.125f, 1e-6f);
  EXPECT_NEAR(viewAngles({0, 0, -1}, true).round, 0.25f, 1e-6f);
  EXPECT_EQ(viewAngles({0, 0, 0}, false).above, 0.0f);
}

TEST(SkyTone, RunsFromTheFootToTheHead) {
  GroundParams params;
  params.low = 1;
  params.high = 0.5f;
  const Floats tone = skyTone(viewOf(1, 4), params, {});
  EXPECT_FLOAT_EQ(tone(0, 0), 1 - 0.5f * 0.875f);
  EXPECT_FLOAT_EQ(tone(0, 3), 1 - 0.5f * 0.125f);
}

TEST(SkyTone, ByViewTheHorizonAndAllBelowAreLow) {
  const CameraRays rays = levelCamera(64, 64);
  GroundParams params;
  params.row = GroundParams::Row::view;
  params.low = 0.9f;
  params.high = 0.1f;
  const Floats tone = skyTone(viewOf(64, 64, &rays), params, {});
  EXPECT_EQ(tone(32, 63), 0.9f);
  EXPECT_NEAR(tone(32, 31), 0.9f, 0.05f);
  // 45 degrees up is half the way to the zenith: 1 - (1/2)² of it.
  EXPECT_NEAR(tone(32, 0), 0.9f - 0.8f * 0.75f, 0.02f);
  const Floats without = skyTone(viewOf(64, 64), params, {});
  EXPECT_LT(without(0, 0), without(0, 63));
}

TEST(SkyTone, ByBeautyItIsTheBrightness) {
  GroundParams params;
  params.row = GroundParams::Row::beauty;
  Vec3Plane beauty(3, 1);
  beauty.set(0, 0, V3f(0.0f));
  beauty.set(1, 0, V3f(0.217638f));  // 0.5^2.2
  beauty.set(2, 0, V3f(4.0f));
  const Floats tone = skyTone(viewOf(3, 1), params, beauty);
  EXPECT_EQ(tone(0, 0), 0.0f);
  EXPECT_NEAR(tone(1, 0), 0.5f, 1e-4f);
  EXPECT_EQ(tone(2, 0), 1.0f);
}

TEST(PaintedSky, ACropShowsTheSameSky) {
  const Strip strip = softStrip();
  const SkyView whole = viewOf(40, 20);
  SkyView crop{10, 10, 5, 7, 40, 20};
  const GroundParams params;
  const ColourPlanes all = paintSky(strip, skyTone(whole, params, {}), whole, params);
  const ColourPlanes part = paintSky(strip, skyTone(crop, params, {}), crop, params);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) ASSERT_EQ(part.r(x, y), all.r(x + 5, y + 7));
}

TEST(PaintedSky, OnTheWorldItTurnsWithTheDirections) {
  const Strip strip = softStrip();
  const CameraRays rays = levelCamera(64, 64);
  CameraRays turned = rays;
  // A quarter turn to the left: X becomes Y.
  const auto turn = [](const V3d& d) { return V3d(-d.y, d.x, d.z); };
  turned.direction0 = turn(rays.direction0);
  turned.directionX = turn(rays.directionX);
  turned.directionY = turn(rays.directionY);
  GroundParams params;
  params.fixed = GroundParams::Fixed::world;
  params.width = 90;  // four widths to the turn: after a quarter all is the same
  const SkyView a = viewOf(64, 64, &rays), b = viewOf(64, 64, &turned);
  const ColourPlanes first = paintSky(strip, skyTone(a, params, {}), a, params);
  const ColourPlanes second = paintSky(strip, skyTone(b, params, {}), b, params);
  double strokes = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      ASSERT_NEAR(first.r(x, y), second.r(x, y), 2e-3f);
      strokes = std::max(strokes, double(std::fabs(first.r(x, y) - first.r(32, y))));
    }
  EXPECT_GT(strokes, 0.01);
}

TEST(PaintedSky, TheTurnClosesWithoutASeam) {
  const Strip strip = softStrip();
  CameraRays rays = levelCamera(64, 64);
  // Looks along +X, where turns begin and end.
  const auto turn = [](const V3d& d) { return V3d(d.y, -d.x, d.z); };
  rays.direction0 = turn(rays.direction0);
  rays.directionX = turn(rays.directionX);
  rays.directionY = turn(rays.directionY);
  GroundParams params;
  params.fixed = GroundParams::Fixed::world;
  params.width = 70;  // not a divisor of the turn
  const SkyView view = viewOf(64, 64, &rays);
  const ColourPlanes sky = paintSky(strip, skyTone(view, params, {}), view, params);
  double seam = 0, beside = 0;
  for (int y = 0; y < 64; ++y) {
    seam = std::max(seam, double(std::fabs(sky.r(32, y) - sky.r(31, y))));
    for (int x = 20; x < 44; ++x)
      if (x != 31) beside = std::max(beside, double(std::fabs(sky.r(x + 1, y) - sky.r(x, y))));
  }
  EXPECT_LE(seam, beside);
}

TEST(PaintedSky, ThreadsChangeNothing) {
  const Strip strip = softStrip();
  const SkyView view = viewOf(70, 70);
  const GroundParams params;
  const ColourPlanes many = paintSky(strip, skyTone(view, params, {}), view, params);
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ColourPlanes single = paintSky(strip, skyTone(view, params, {}), view, params);
  for (size_t i = 0; i < many.g.view().pixels(); ++i)
    ASSERT_EQ(many.g.row(0)[i], single.g.row(0)[i]);
}

TEST(FittedPicture, FillsTheFrameAndKeepsItsShape) {
  // 4 x 2 over a square: its height fits, the outer columns are cut off.
  Floats r(4, 2), g(4, 2, 0.5f);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) r(x, y) = float(x);
  const Strip picture = makeStrip(r, g, g);
  const ColourPlanes out = fitPicture(picture, viewOf(2, 2));
  EXPECT_FLOAT_EQ(out.r(0, 0), 1.0f);
  EXPECT_FLOAT_EQ(out.r(1, 1), 2.0f);
  EXPECT_FLOAT_EQ(out.g(1, 0), 0.5f);
  EXPECT_EQ(out.a(0, 1), 1.0f);
}

TEST(FittedPicture, ItsSidesDoNotRunIntoEachOther) {
  Floats r(4, 4, 0.0f);
  for (int y = 0; y < 4; ++y) r(3, y) = 1.0f;
  const ColourPlanes out = fitPicture(makeStrip(r, r, r), viewOf(16, 16));
  EXPECT_EQ(out.r(0, 8), 0.0f);
  EXPECT_EQ(out.r(15, 8), 1.0f);
}

}  // namespace
}  // namespace kagefude
