#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "passes/light_shape/light_mesh.h"
#include "passes/light_shape/light_shape.h"
#include "passes/light_shape/light_share.h"
#include "passes/light_shape/shadow_places.h"

namespace kagefude {
namespace {

/// Centre, corners, then the other places of a lattice, as the exporter lays them.
std::vector<V2f> grid(int columns, int rows) {
  std::vector<V2f> places{{0, 0}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const V2f p(2 * static_cast<float>(i) / static_cast<float>(columns - 1) - 1,
                  2 * static_cast<float>(j) / static_cast<float>(rows - 1) - 1);
      if (std::find(places.begin(), places.end(), p) == places.end()) places.push_back(p);
    }
  return places;
}

const std::vector<std::vector<V2f>> grids = {grid(2, 2), grid(3, 3), grid(4, 2),
                                             grid(8, 2), grid(4, 4), grid(8, 8)};

/// Area of the part of [-1, 1]² where m + g·p > 0, cut side by side, as a share of it.
double cutShare(double m, double gx, double gy) {
  const double corner[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  std::vector<std::pair<double, double>> kept;
  for (int i = 0; i < 4; ++i) {
    const double *a = corner[i], *b = corner[i + 1];
    const double fa = m + gx * a[0] + gy * a[1], fb = m + gx * b[0] + gy * b[1];
    if (fa > 0) kept.emplace_back(a[0], a[1]);
    if ((fa > 0) == (fb > 0)) continue;
    const double t = fa / (fa - fb);
    kept.emplace_back(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]));
  }
  double area = 0;
  for (size_t i = 0; i < kept.size(); ++i) {
    const auto &a = kept[i], &b = kept[(i + 1) % kept.size()];
    area += 0.5 * (a.first * b.second - b.first * a.second);
  }
  return area / 4;
}

TEST(Rectangle, IsToldByItsFourCorners) {
  for (const auto& places : grids) EXPECT_TRUE(placesOnRectangle(places)) << places.size();
  std::vector<V2f> places = grid(3, 3);
  places[2] = V2f(0.7f, -0.7f);
  EXPECT_FALSE(placesOnRectangle(places));
}

TEST(Rectangle, MeshCoversItWhole) {
  for (const auto& places : grids) EXPECT_NEAR(LightMesh(places).area(), 4, 1e-5) << places.size();
}

TEST(Rectangle, AnEdgeAcrossItLeavesTheShareThatIsCutOff) {
  for (const auto& places : grids)
    for (const double m : {-1.3, -0.6, 0.0, 0.25, 0.9})
      for (const double radius : {1.0, 0.4}) {
        std::vector<float> s;
        for (const V2f& p : places)
          s.push_back(static_cast<float>(m + 1.1 * double{p.x} - 0.5 * double{p.y}));
        const double exact = cutShare(m, 1.1 * radius, -0.5 * radius);
        const auto size = static_cast<float>(radius);
        EXPECT_NEAR(LightShare(places, false, size).of(s.data()), exact, 1e-5) << places.size();
        EXPECT_NEAR(LightShare(places, true, size).of(s.data()), exact, 1e-5) << places.size();
      }
}

TEST(Rectangle, ShrinksToTheHardMaskOfItsCentre) {
  for (const auto& places : grids)
    for (const bool lit : {false, true}) {
      std::vector<float> s(places.size(), lit ? -2.0f : 2.0f);
      s[0] = lit ? 0.5f : -0.5f;
      for (const bool linear : {false, true})
        EXPECT_NEAR(LightShare(places, linear, 0).of(s.data()), lit ? 1 : 0, 1e-6);
    }
}

TEST(Rectangle, FollowedPlacesFillItEvenly) {
  const std::vector<V2f> places = grid(4, 2);
  const ShadowPlaces found = placesBetween(places, 72, 0.5f);
  ASSERT_EQ(found.count, 72);
  int quadrant[4] = {}, rim = 0;
  V2f mean(0, 0);
  for (int i = 0; i < found.count; ++i) {
    const V2f p = places[static_cast<size_t>(found.mask[0][i])] + V2f(found.x[0][i], found.y[0][i]);
    ASSERT_LE(std::max(std::fabs(p.x), std::fabs(p.y)), 0.5f);
    mean += p / 72.0f;
    ++quadrant[(p.x > 0) + 2 * (p.y > 0)];
    rim += p.length() > 0.5f;
    EXPECT_NEAR(found.weight[0][i] + found.weight[1][i] + found.weight[2][i], 1, 1e-5);
  }
  EXPECT_LT(mean.length(), 1e-5f) << "else all penumbrae lean to one side";
  for (const int count : quadrant) EXPECT_NEAR(count, 18, 3);
  EXPECT_NEAR(rim, 72 * (1 - M_PI / 4), 4) << "beyond the disc that it holds";
}

/// A floor seen from above under a rectangle whose shadows shift by (sx, sy) pixels a half side.
LightShapeResult floorUnder(const std::vector<V2f>& places, float sx, float sy, bool follow,
                            bool (*lit)(float, float)) {
  constexpr int width = 160, height = 96;
  const Labels labels(width, height, 1u);
  Vec3Plane position(width, height), normal(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      position.set(x, y, V3f(static_cast<float>(x), static_cast<float>(y), 0));
      normal.set(x, y, V3f(0, 0, 1));
    }
  std::vector<Bytes> masks;
  for (const V2f& p : places) {
    Bytes& mask = masks.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        mask(x, y) = lit(static_cast<float>(x) + sx * p.x, static_cast<float>(y) + sy * p.y);
  }
  LightGeometry geometry;
  geometry.position = V3f(80, 48, 1000);
  geometry.u = V3f(sx, 0, 0);
  geometry.v = V3f(0, sy, 0);
  LightShapeParams params;
  params.follow = follow;
  return lightShapeVisibility({std::vector<View<const uint8_t>>(masks.begin(), masks.end())},
                              places, labels, position, normal, geometry, params);
}

TEST(Rectangle, StraightEdgeHasALinearPenumbraOfEachSidesWidth) {
  for (const auto& places : {grid(3, 3), grid(4, 2)})
    for (const bool follow : {false, true}) {
      const LightShapeResult across =
          floorUnder(places, 20, 4, follow, [](float x, float) { return x > 79.5f; });
      for (int x = 50; x < 110; ++x)
        EXPECT_NEAR(across.visibility(x, 48), std::clamp(0.5 + (x - 79.5) / 40, 0.0, 1.0), 0.03)
            << x << " " << follow;
      const LightShapeResult along =
          floorUnder(places, 20, 4, follow, [](float, float y) { return y > 47.5f; });
      for (int y = 30; y < 66; ++y)
        EXPECT_NEAR(along.visibility(80, y), std::clamp(0.5 + (y - 47.5) / 8, 0.0, 1.0), 0.08)
            << y << " " << follow;
    }
}

TEST(Rectangle, StripThinnerThanTheMasksSpacingIsFollowed) {
  const LightShapeResult found = floorUnder(
      grid(4, 2), 30, 6, true, [](float x, float) { return std::fabs(x - 79.5f) > 2.0f; });
  double error = 0;
  for (int x = 40; x < 120; ++x) {
    // The strip, 4 wide, hides 4 of the 60 pixels of the light's shift where it lies within.
    const double from = std::clamp((x - 79.5 - 2) / 60 + 0.5, 0.0, 1.0);
    const double to = std::clamp((x - 79.5 + 2) / 60 + 0.5, 0.0, 1.0);
    const double off = found.visibility(x, 48) - (1 - (to - from));
    error += off * off;
  }
  EXPECT_LT(std::sqrt(error / 80), 0.04);
}

}  // namespace
}  // namespace kagefude
