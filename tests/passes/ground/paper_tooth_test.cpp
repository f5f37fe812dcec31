#include "passes/ground/paper_tooth.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace kagefude {
namespace {

constexpr int width = 64, height = 48;

/// A wall in the plane Y = 10, seen along +Y; the camera may stand aside and turn.
struct Wall {
  CameraRays rays;
  Vec3Plane position{width, height}, normal{width, height};
  Plane<uint16_t> index{width, height};
  std::vector<BrushAnchor> anchors = std::vector<BrushAnchor>(1);

  explicit Wall(double aside, uint16_t thing = 1) {
    const double step = 2.0 / width;
    rays.eye = V3d(aside, 0, 0);
    rays.directionX = V3d(step, 0, 0);
    rays.directionY = V3d(0, 0, -step);
    rays.direction0 = V3d(-1, 1, step * height / 2);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const V3d d = rays.direction(x + 0.5, y + 0.5);
        position.set(x, y, V3f(rays.eye + d * 10.0));
        normal.set(x, y, V3f(0, -1, 0));
        index(x, y) = thing;
      }
  }
  PaperTooth tooth(const ToothTile& tile) const {
    ToothPlaces places{position, normal, {}, index, anchors};
    places.rays = &rays;
    return worldTooth(tile, places);
  }
};

TEST(PaperTooth, OnTheScreenACropShowsTheSamePaper) {
  const ToothTile tile{PaperParams{}};
  const PaperSurface whole(ToothTile(PaperParams{}), 0, 0), part(ToothTile(PaperParams{}), 11, -3);
  ToothRun a, b;
  for (int y = 3; y < 8; ++y) {
    whole.read(13, y - 3, 10, a);
    part.read(2, y, 10, b);
    for (int x = 0; x < 10; ++x) {
      ASSERT_EQ(a.height[x], b.height[x]);
      ASSERT_EQ(a.slope[x], b.slope[x]);
      ASSERT_EQ(a.height[x], tile.at(13 + x, y - 3).height);
    }
  }
}

TEST(PaperTooth, ASurfaceOfPlanesGivesTheirRuns) {
  EXPECT_TRUE(PaperSurface().empty());
  const ToothTile tile{PaperParams{}};
  const PaperTooth tooth = Wall(0).tooth(tile);
  const PaperSurface surface(Wall(0).tooth(tile));
  ASSERT_FALSE(surface.empty());
  ToothRun run;
  surface.read(5, 7, 20, run);
  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(run.height[x], tooth.height(5 + x, 7));
    EXPECT_EQ(run.slope[x], tooth.slope(5 + x, 7));
  }
}

TEST(PaperTooth, OnAnObjectItStaysWhileTheCameraMoves) {
  const ToothTile tile{PaperParams{}};
  // Four pixels of the wall aside: 10 x 4 x 2 / 64. Distances to the eye differ a little.
  const PaperTooth a = Wall(0).tooth(tile), b = Wall(10.0 * 4 * 2 / width).tooth(tile);
  double moved = 0, still = 0;
  for (int y = 8; y < 40; ++y)
    for (int x = 16; x < 44; ++x) {
      moved += std::fabs(a.height(x + 4, y) - b.height(x, y));
      still += std::fabs(a.height(x, y) - b.height(x, y));
    }
  EXPECT_LT(moved, 0.4 * still);
}

TEST(PaperTooth, ItIsOfTheSizeThatWasAskedForAtEveryDistance) {
  PaperParams params;
  params.grain = 6;
  const ToothTile tile(params);
  const PaperTooth tooth = Wall(0).tooth(tile);
  int crossings = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 1; x < width; ++x)
      crossings += (tooth.height(x, y) < 0.5f) != (tooth.height(x - 1, y) < 0.5f);
  const double size = double(width) * height / crossings;
  EXPECT_GT(size, 3.0);
  EXPECT_LT(size, 12.0);
}

TEST(PaperTooth, BehindThingsItTurnsWithTheDirections) {
  const ToothTile tile{PaperParams{}};
  const Wall first(0, 0), second(25, 0);  // the sky is as far as ever
  const PaperTooth a = first.tooth(tile), b = second.tooth(tile);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ASSERT_EQ(a.height(x, y), b.height(x, y));
}

TEST(PaperTooth, HeightsStayWithinTheirRangeAndThreadsChangeNothing) {
  const ToothTile tile{PaperParams{}};
  Wall wall(3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      wall.normal.set(x, y, V3f(std::sin(float(x)), -1, std::cos(float(y))));
  wall.normal.set(3, 3, V3f(0.0f));
  const PaperTooth many = wall.tooth(tile);
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const PaperTooth single = wall.tooth(tile);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      ASSERT_GE(many.height(x, y), 0.0f);
      ASSERT_LE(many.height(x, y), 1.0f);
      ASSERT_EQ(many.height(x, y), single.height(x, y));
      ASSERT_TRUE(std::isfinite(many.slope(x, y)));
    }
}

}  // namespace
}  // namespace kagefude
