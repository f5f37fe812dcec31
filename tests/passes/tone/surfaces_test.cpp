#include "passes/tone/surfaces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "passes/random_image.h"
#include "passes/tone/surface_joins.h"

namespace kagefude {
namespace {

/// A frame of one object on the plane z = 0, a pixel a unit, that tests then bend.
struct Scene {
  Labels ids;
  Vec3Plane normal, position;

  Scene(int width, int height)
      : ids(width, height, 1), normal(width, height), position(width, height) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) set(x, y, V3f(x, y, 0), V3f(0, 0, 1));
  }
  void set(int x, int y, const V3f& p, const V3f& n) {
    position.set(x, y, p);
    normal.set(x, y, n);
  }
  Labels labels(const SurfacesParams& params = {}) const {
    return labelSurfaces(ids, normal, position, params);
  }
};

TEST(Surfaces, NumberedByFirstPixelInRasterOrder) {
  Scene s(4, 2);
  s.ids(0, 0) = 0;
  s.ids(1, 0) = 9;
  s.ids(2, 0) = s.ids(3, 0) = 4;
  for (int x = 0; x < 4; ++x) s.ids(x, 1) = x < 3 ? 7 : 9;
  const Labels l = s.labels();
  const uint32_t expected[] = {0, 1, 2, 2, 3, 3, 3, 4};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(l(i % 4, i / 4), expected[i]) << i;
}

TEST(Surfaces, ACubesEdgeSplits) {
  Scene s(6, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 3; x < 6; ++x) s.set(x, y, V3f(3, y, x - 3), V3f(1, 0, 0));
  const Labels l = s.labels();
  EXPECT_EQ(l(0, 0), 1u);
  EXPECT_EQ(l(5, 2), 2u);
  SurfacesParams wide;
  wide.angle = 89;
  wide.gap = 1;
  EXPECT_EQ(s.labels(wide)(5, 2), 2u) << "a right angle splits whatever the parameters";
}

TEST(Surfaces, TheAngleDecides) {
  Scene s(2, 1);
  const float turn = 25.0f * 3.14159265f / 180.0f;
  s.normal.set(1, 0, V3f(std::sin(turn), 0, std::cos(turn)));
  EXPECT_EQ(s.labels()(1, 0), 1u);
  SurfacesParams narrow;
  narrow.angle = 20;
  EXPECT_EQ(s.labels(narrow)(1, 0), 2u);
}

TEST(Surfaces, AStepBetweenParallelPlanesSplits) {
  Scene s(6, 1);
  for (int x = 3; x < 6; ++x) s.position.set(x, 0, V3f(x, 0, 2));
  EXPECT_EQ(s.labels()(2, 0), 1u);
  EXPECT_EQ(s.labels()(3, 0), 2u);
}

TEST(Surfaces, AStepSeenAtAGrazingAngleSplits) {
  // Treads whose pixels are 1 apart, a step of height 2 that hides 20 units of depth.
  Scene s(6, 1);
  for (int x = 3; x < 6; ++x) s.position.set(x, 0, V3f(x + 20, 0, 2));
  EXPECT_EQ(s.labels()(3, 0), 2u);
}

TEST(Surfaces, AGrazingPlaneIsOneSurface) {
  Scene s(40, 1);
  for (int x = 0; x < 40; ++x) s.position.set(x, 0, V3f(std::pow(1.3f, x), 0, 0));
  EXPECT_EQ(s.labels()(39, 0), 1u);
}

TEST(Surfaces, ASphereIsOneSurface) {
  const int size = 64;
  Scene s(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float u = (x + 0.5f) / 30.0f - 32.0f / 30.0f, v = (y + 0.5f) / 30.0f - 32.0f / 30.0f;
      const float d = 1 - u * u - v * v;
      s.ids(x, y) = d > 0;
      if (d > 0) s.set(x, y, V3f(u, v, std::sqrt(d)), V3f(u, v, std::sqrt(d)));
    }
  const Labels l = s.labels();
  int others = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) others += l(x, y) > 1;
  EXPECT_EQ(others, 0);
}

TEST(Surfaces, DiagonalNeighboursConnect) {
  Scene s(5, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) s.ids(x, y) = x == y ? 1 : 0;
  EXPECT_EQ(s.labels()(4, 4), 1u);
}

TEST(Surfaces, UnknownPositionsStandAlone) {
  Scene s(3, 1);
  s.position.set(1, 0, V3f(std::numeric_limits<float>::quiet_NaN(), 0, 0));
  const Labels l = s.labels();
  EXPECT_EQ(l(1, 0), 2u);
  EXPECT_EQ(l(2, 0), 3u);
}

TEST(Surfaces, WithoutNormalsAndPositionsTheIdsCount) {
  Scene s(3, 1);
  s.ids(1, 0) = 2;
  const Labels l = labelSurfaces(s.ids, {}, {}, {});
  EXPECT_EQ(l(0, 0), 1u);
  EXPECT_EQ(l(1, 0), 2u);
  EXPECT_EQ(l(2, 0), 3u);
}

/// Floods from each pixel in raster order.
Labels flooded(const Labels& ids) {
  Labels l(ids.width(), ids.height(), 0);
  uint32_t next = 0;
  std::vector<std::pair<int, int>> open;
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x) {
      if (ids(x, y) == 0 || l(x, y) != 0) continue;
      l(x, y) = ++next;
      open.emplace_back(x, y);
      while (!open.empty()) {
        const auto [u, v] = open.back();
        open.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int p = u + dx, q = v + dy;
            if (!ids.view().contains(p, q) || ids(p, q) != ids(u, v) || l(p, q) != 0) continue;
            l(p, q) = next;
            open.emplace_back(p, q);
          }
      }
    }
  return l;
}

TEST(Surfaces, EqualsAFloodFillForAnyNumberOfThreads) {
  for (const int count : {2, 3, 5000}) {
    const Labels ids = test::randomLabels(150, 260, count, 2, 11);
    const Labels expected = flooded(ids);
    for (const size_t threads : {1, 2, 4}) {
      tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      EXPECT_TRUE(test::equalBits<uint32_t>(labelSurfaces(ids, {}, {}, {}), expected)) << count;
    }
  }
}

TEST(Surfaces, KeepsTheJoinsThatItGoesByForAnyNumberOfThreads) {
  const Scene s(70, 150);
  const Labels ids = test::randomLabels(70, 150, 2, 2, 5);
  const SurfaceJoins joins(ids, s.normal, s.position, {});
  for (const size_t threads : {1, 4}) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Bytes kept;
    labelSurfaces(ids, s.normal, s.position, {}, &kept);
    std::vector<uint8_t> row(70);
    for (int y = 0; y < 150; ++y)
      for (const auto& [step, way] : {std::pair{NeighbourStep{1, 0}, joinedRight},
                                      {NeighbourStep{0, 1}, joinedDown},
                                      {NeighbourStep{-1, 1}, joinedDownLeft},
                                      {NeighbourStep{1, 1}, joinedDownRight}}) {
        joins.row(y, step, row.data());
        for (int x = 0; x < 70; ++x)
          ASSERT_EQ((kept(x, y) & way) != 0, row[static_cast<size_t>(x)] != 0) << x << " " << y;
      }
  }
}

TEST(Surfaces, RefusesPlanesOfOtherSizes) {
  const Scene s(3, 3), other(3, 2);
  EXPECT_THROW(labelSurfaces(s.ids, other.normal, s.position, {}), InputError);
  EXPECT_THROW(labelSurfaces(s.ids, s.normal, other.position, {}), InputError);
}

}  // namespace
}  // namespace kagefude
