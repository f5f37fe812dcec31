#include "passes/depth_map/back_projection.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "base/error.h"
#include "passes/depth_map/map_floor.h"
#include "passes/depth_map/map_taps.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

constexpr float lightHeight = MapFloor::lightHeight;

struct Floor : MapFloor {
  using MapFloor::MapFloor;

  Floats visibility(float radius) const { return with(radius, {}).visibility; }
  BackProjection with(float radius, std::span<const PlacedMask> masks) const {
    return backProject(position, normal, labels, map, radius, 0.5f, masks);
  }
};

bool left(int x, int) { return x < 128; }

TEST(BackProjection, AStraightEdgeGivesTheShareOfTheDiscBesideIt) {
  for (const float blocker : {2.5f, 5.0f, 8.0f}) {
    Floor floor;
    floor.block(blocker, left);
    const float radius = 0.5f;
    const Floats v = floor.visibility(radius);
    for (int x = 0; x < 400; ++x) {
      // The way from the receiver through the edge, over the middle, meets the light's plane here.
      const float onLight = -floor.position.view()(x, 0).x * blocker / (lightHeight - blocker);
      EXPECT_NEAR(v(x, 0), discShare(-onLight / radius), 0.025f) << blocker << " at " << x;
    }
  }
}

TEST(BackProjection, NoBlockerIsLit) {
  const Floats v = Floor().visibility(1);
  for (int x = 0; x < 400; ++x) EXPECT_EQ(v(x, 0), 1.0f);
}

TEST(BackProjection, BlockersBeforeOneAnotherCountOnce) {
  Floor one, two;
  one.block(4, [](int x, int) { return x < 120; });
  two.block(4, [](int x, int) { return x < 120; });
  // What stands in the first one's shadow hides nothing more; the map could not even show it.
  const Floats a = one.visibility(0.8f);
  two.block(4, [](int x, int) { return x < 60; });
  const Floats b = two.visibility(0.8f);
  for (int x = 0; x < 400; ++x) EXPECT_EQ(a(x, 0), b(x, 0));
}

/// Blockers of one depth hide exactly the points of the light whose ways meet a blocking texel.
TEST(BackProjection, RandomBlockersHideWhatANaiveSearchSays) {
  std::mt19937 dice(7);
  Floor floor(64, 64, 6);
  const float blocker = 5, radius = 0.7f;
  Bytes blocking(256, 256, uint8_t{0});
  for (int i = 0; i < 60; ++i) {
    const int x0 = static_cast<int>(dice() % 250), y0 = static_cast<int>(dice() % 250);
    const int w = 1 + static_cast<int>(dice() % 24), h = 1 + static_cast<int>(dice() % 24);
    for (int y = y0; y < std::min(256, y0 + h); ++y)
      for (int x = x0; x < std::min(256, x0 + w); ++x) blocking(x, y) = 1;
  }
  floor.block(blocker, [&](int x, int y) { return blocking(x, y) != 0; });
  const Floats v = floor.visibility(radius);
  const std::vector<V2f> points = spiralPoints(1024);
  double squares = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const V3f p = floor.position.view()(x, y);
      int seen = 0;
      for (const V2f& point : points) {
        // Half way between receiver and light, as tangents, in texels.
        const float across = 0.5f * (p.x + radius * point.x) / blocker;
        const float up = 0.5f * (p.y + radius * point.y) / blocker;
        const int column = static_cast<int>((across * 0.5f + 0.5f) * 256);
        const int row = static_cast<int>((0.5f - up * 0.5f) * 256);
        seen += blocking(column, row) == 0;
      }
      const float error = v(x, y) - static_cast<float>(seen) / 1024;
      EXPECT_LT(std::fabs(error), 0.06f) << x << ", " << y;
      squares += error * error;
    }
  EXPECT_LT(std::sqrt(squares / (64 * 64)), 0.015);
}

TEST(BackProjection, ASlantedBlockerHasNoGaps) {
  Floor floor;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) floor.depth(x, y) = 3 + 4 * static_cast<float>(x) / 256;
  const Floats v = floor.visibility(0.5f);
  for (int x = 40; x < 360; ++x) EXPECT_EQ(v(x, 0), 0.0f) << x;
}

TEST(BackProjection, TheReceiversHorizonHidesWhatLiesBelow) {
  Floor floor(1);
  floor.position.set(0, 0, V3f(0, 0, 0));
  floor.normal.set(0, 0, V3f(1, 0, 0));
  EXPECT_NEAR(floor.visibility(0.5f)(0, 0), 0.5f, 0.02f);
  floor.normal.set(0, 0, V3f(0, 0, -1));
  EXPECT_EQ(floor.visibility(0.5f)(0, 0), 0.0f);
}

TEST(BackProjection, ACurvedReceiverDoesNotHideItself) {
  // A ball of radius 2 on the floor, facing the light: all that the map shows of it is its own.
  Floor floor(200);
  const V3f centre(0, 0, 2);
  const auto ballAt = [&](float tx, float ty) {
    // Nearest of the ball along (tx, ty, -1) from the light.
    const V3f way(tx, ty, -1), from = V3f(0, 0, lightHeight) - centre;
    const float a = way.dot(way), b = way.dot(from), c = from.dot(from) - 4;
    const float inside = b * b - a * c;
    return inside < 0 ? lightHeight : (-b - std::sqrt(inside)) / a;
  };
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      floor.depth(x, y) = ballAt((static_cast<float>(x) + 0.5f) / 128 - 1,
                                 1 - (static_cast<float>(y) + 0.5f) / 128);
  for (int i = 0; i < 200; ++i) {
    const float angle = 1.2f * (static_cast<float>(i) / 100 - 1);
    const V3f n(std::sin(angle), 0, std::cos(angle));
    floor.normal.set(i, 0, n);
    floor.position.set(i, 0, centre + n * 2.0f);
  }
  const Floats v = floor.visibility(0.3f);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(v(i, 0), 1.0f) << i;
}

TEST(BackProjection, MasksThatTheMapBearsOutAreNotContradicted) {
  Floor floor;
  floor.block(5, left);
  Bytes right(400, 1, uint8_t{0}), wrong(400, 1, uint8_t{0});
  for (int x = 0; x < 400; ++x) {
    // Of the place 0.5 to the right of the light's centre: its shadow's edge runs at x = -0.5.
    right(x, 0) = floor.position.view()(x, 0).x > -0.5f;
    wrong(x, 0) = !right(x, 0);
  }
  const PlacedMask masks[] = {{right, V3f(0.5f, 0, 0)}, {wrong, V3f(0.5f, 0, 0)}};
  const BackProjection back = floor.with(0.5f, masks);
  for (int x = 0; x < 400; ++x) {
    if (std::fabs(floor.position.view()(x, 0).x + 0.5f) < 0.05f) continue;  // beside the edge
    EXPECT_EQ(back.contradicted(x, 0), 1) << x;
  }
}

TEST(BackProjection, ASunIsWideByItsAngle) {
  Floor floor;
  floor.block(5, left);
  floor.map.clipFromLight = {};
  floor.map.clipFromLight.m[0][0] = floor.map.clipFromLight.m[1][1] = 0.1;
  floor.map.clipFromLight.m[2][2] = -0.1;
  const float tangent = 0.1f;
  Bytes mask(400, 1, uint8_t{0});
  for (int x = 0; x < 400; ++x) mask(x, 0) = floor.position.view()(x, 0).x > -0.25f;
  // Half the sun's radius to the right: the edge, 5 over the floor, throws its shadow 0.25 to the
  // left.
  const PlacedMask masks[] = {{mask, V3f(0.05f, 0, 0)}};
  const BackProjection back = floor.with(tangent, masks);
  for (int x = 0; x < 400; ++x) {
    const float place = floor.position.view()(x, 0).x;
    EXPECT_NEAR(back.visibility(x, 0), discShare(place / (5 * tangent)), 0.05f) << x;
    if (std::fabs(place + 0.25f) > 0.05f) {
      EXPECT_EQ(back.contradicted(x, 0), 0) << x;
    }
  }
}

TEST(BackProjection, LargeFramesAreInterpolatedWherePenumbraeAreWide) {
  for (const int width : {1400, 2600}) {  // by four, by eight
    const int height = width == 1400 ? 800 : 1701;
    Floor floor(width, height);
    floor.block(5, left);
    const float radius = 1.0f;
    const Floats v = floor.visibility(radius);
    for (int y = 0; y < height; y += 50)
      for (int x = 0; x < width; ++x)
        EXPECT_NEAR(v(x, y), discShare(floor.position.view()(x, y).x / radius), 0.03f);
  }
}

TEST(BackProjection, LargeFramesGiveLonePixelsTheirOwnAnswer) {
  Floor small(640, 1), large(2600, 1701);
  for (Floor* floor : {&small, &large}) floor->block(5, left);
  Bytes wanted(2600, 1701, uint8_t{0});
  for (int x = 3; x < 2600; x += 41) wanted(x, 777) = 1;
  const auto hidden = [&](const V3f& p) {
    small.position.set(0, 0, p);
    return small.visibility(0.3f)(0, 0);
  };
  const BackProjection back =
      backProject(large.position, large.normal, large.labels, large.map, 0.3f, 0.5f, {}, wanted);
  for (int x = 0; x < 2600; ++x)
    EXPECT_NEAR(back.visibility(x, 777),
                wanted(x, 777) ? hidden(large.position.view()(x, 777)) : 1.0f, 0.06f)
        << x;
}

TEST(BackProjection, WhatIsNotWantedIsPassedOver) {
  Floor floor;
  floor.block(5, left);
  Bytes wanted(400, 1, uint8_t{0});
  wanted(50, 0) = 1;
  const BackProjection back =
      backProject(floor.position, floor.normal, floor.labels, floor.map, 0.5f, 0.5f, {}, wanted);
  EXPECT_EQ(back.visibility(50, 0), 0.0f);
  EXPECT_EQ(back.visibility(49, 0), 1.0f);
}

TEST(BackProjection, BackgroundBehindTheLightAndNanAreLit) {
  Floor floor;
  floor.block(5, [](int, int) { return true; });
  floor.labels(10, 0) = 0;
  floor.position.set(11, 0, V3f(0, 0, 12));
  floor.position.set(12, 0, V3f(std::numeric_limits<float>::quiet_NaN(), 0, 0));
  const Floats v = floor.visibility(0.5f);
  EXPECT_EQ(v(200, 0), 0.0f);
  for (const int x : {10, 11, 12}) EXPECT_EQ(v(x, 0), 1.0f) << x;
}

TEST(BackProjection, APlaceAsFarAsTheReceiverHolds) {
  Floor floor;
  const Bytes seen(400, 1, uint8_t{1});
  // Seen from the floor this place lies at the horizon of the light's plane: nowhere on its disc.
  const PlacedMask masks[] = {{seen, V3f(0.1f, 0, -lightHeight)}};
  const BackProjection back = floor.with(0.5f, masks);
  for (int x = 0; x < 400; ++x) EXPECT_EQ(back.visibility(x, 0), 1.0f) << x;
}

TEST(BackProjection, NanDepthsAndRadiusZeroHold) {
  Floor floor;
  floor.block(std::numeric_limits<float>::quiet_NaN(), [](int, int) { return true; });
  const Floats open = floor.visibility(0.5f);
  for (int x = 0; x < 400; ++x) EXPECT_EQ(open(x, 0), 1.0f);
  Floor hard;
  hard.block(5, left);
  const Floats v = hard.visibility(0);
  for (int x = 0; x < 400; ++x) EXPECT_EQ(v(x, 0), x < 200 ? 0.0f : 1.0f) << x;
}

TEST(BackProjection, RefusesOtherSizesAndAnEmptyMap) {
  Floor floor;
  const Vec3Plane small(3, 1);
  EXPECT_THROW(backProject(small, floor.normal, floor.labels, floor.map, 1, 0.5f, {}), InputError);
  EXPECT_THROW(backProject(floor.position, small, floor.labels, floor.map, 1, 0.5f, {}),
               InputError);
  floor.map.depth = {};
  EXPECT_THROW(floor.visibility(1), InputError);
}

}  // namespace
}  // namespace kagefude
