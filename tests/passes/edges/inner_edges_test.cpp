#include "passes/edges/inner_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace kagefude {
namespace {

constexpr int frameSide = 24;

// Two surfaces of one object, one white and one black, seen by a parallel camera from above: a
// pixel is one unit. Both are given by their heights.
struct Picture {
  using Height = std::function<double(double, double)>;
  Labels ids{frameSide, frameSide, 1u};
  std::vector<uint32_t> objects{0, 1, 1};  ///< of the styles
  Plane<uint16_t> styles{frameSide, frameSide, uint16_t{1}};
  Vec3Plane normal{frameSide, frameSide}, position{frameSide, frameSide};
  Floats r{frameSide, frameSide}, g{frameSide, frameSide, 0.0f}, b{frameSide, frameSide, 0.0f},
      a{frameSide, frameSide, 1.0f};
  CameraRays rays;
  std::function<bool(double, double)> white;

  Picture(const Height& whiteHeight, const Height& blackHeight,
          const std::function<bool(double, double)>& isWhite)
      : white(isWhite) {
    rays.orthographic = true;
    rays.originX = {1, 0, 0};
    rays.originY = {0, 1, 0};
    rays.direction0 = {0, 0, -1};
    rays.origin0 = {0, 0, 100};
    for (int y = 0; y < frameSide; ++y)
      for (int x = 0; x < frameSide; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const Height& height = isWhite(px, py) ? whiteHeight : blackHeight;
        const double z = height(px, py);
        position.set(x, y,
                     V3f(static_cast<float>(px), static_cast<float>(py), static_cast<float>(z)));
        constexpr double step = 1e-4;
        const V3d up((z - height(px + step, py)) / step, (z - height(px, py + step)) / step, 1);
        normal.set(x, y, V3f(up.normalized()));
        r(x, y) = isWhite(px, py) ? 1.0f : 0.0f;
      }
  }

  void blend() {
    Bytes joins;
    labelSurfaces(ids, normal, position, {}, &joins);
    const EdgeSurfaces surfaces{objects, styles, joins, normal, position, &rays, false};
    blendInnerEdges(surfaces, {r.view(), g.view(), b.view(), a.view()});
  }

  float area(int x, int y) const {
    int inside = 0;
    for (int v = 0; v < 32; ++v)
      for (int u = 0; u < 32; ++u) inside += white(x + (u + 0.5) / 32, y + (v + 0.5) / 32);
    return static_cast<float>(inside) / 1024;
  }

  // Root mean square over the pixels that the edge crosses, away from the border.
  float error() const {
    double sum = 0;
    int count = 0;
    for (int y = 2; y < frameSide - 2; ++y)
      for (int x = 2; x < frameSide - 2; ++x) {
        const float share = area(x, y);
        if (share <= 0 || share >= 1) continue;
        sum += (r(x, y) - share) * (r(x, y) - share);
        ++count;
      }
    return static_cast<float>(std::sqrt(sum / count));
  }
};

Picture roof(double slope, double start) {
  const auto beside = [=](double x, double y) { return y - start - slope * x; };
  return {[=](double x, double y) { return -2 * std::fabs(beside(x, y)); },
          [=](double x, double y) { return -1.5 * std::fabs(beside(x, y)); },
          [=](double x, double y) { return beside(x, y) > 0; }};
}

TEST(InnerEdges, ACreaseIsCutExactlyAtEverySlope) {
  for (const double slope : {-3.0, -1.0, -0.37, 0.0, 0.05, 0.5, 1.0, 1.9}) {
    Picture picture = roof(slope, 12.3 - 12 * slope);
    picture.blend();
    EXPECT_LT(picture.error(), 0.02f) << slope << ": the grid that counts is as coarse";
  }
}

TEST(InnerEdges, AHollowCreaseToo) {
  Picture picture{[](double x, double y) { return std::fabs(y - 8.2 - 0.3 * x); },
                  [](double x, double y) { return 1.5 * std::fabs(y - 8.2 - 0.3 * x); },
                  [](double x, double y) { return y - 8.2 - 0.3 * x > 0; }};
  picture.blend();
  EXPECT_LT(picture.error(), 0.01f);
}

// Against the 0.29 of one sample a pixel (a uniform error between -1/2 and 1/2).
TEST(InnerEdges, AStepsStaircaseIsMadeALine) {
  for (const double slope : {-0.5, 0.0, 0.1, 0.2, 0.333, 0.77, 1.0, 2.0, 5.0}) {
    const auto isWhite = [=](double x, double y) { return y > 12.4 + slope * (x - 12); };
    Picture picture{[](double, double) { return 9.0; }, [](double, double) { return 0.0; },
                    isWhite};
    const float before = picture.error();
    picture.blend();
    EXPECT_LT(picture.error(), slope == 0.0 ? before * 1.01f : 0.17f) << slope;
  }
}

// Its tangent planes meet the floor about where it ends.
TEST(InnerEdges, ABallsOutlineIsNotMadeWorse) {
  const auto beside = [](double x, double y) { return std::hypot(x - 12.2, y - 11.7) / 8.3; };
  Picture picture{[=](double x, double y) {
                    const double r = std::min(beside(x, y), 1.0);
                    return 8.3 * std::sqrt(1 - r * r);
                  },
                  [](double, double) { return 0.0; },
                  [=](double x, double y) { return beside(x, y) < 1; }};
  const float before = picture.error();
  picture.blend();
  EXPECT_LT(picture.error(), before);
}

TEST(InnerEdges, ACornerOfThreeSidesIsCutByAll) {
  // A corner from above: a white top and two black sides.
  const auto top = [](double x, double y) { return x - 12.3 > 0 && y - 11.6 > 0; };
  Picture picture{[](double, double) { return 0.0; },
                  [](double x, double y) {
                    return std::min({2 * (x - 12.3), 2 * (y - 11.6), 0.0});
                  },
                  top};
  const float before = picture.error();
  picture.blend();
  EXPECT_LT(picture.error(), before * 0.5f);
}

TEST(InnerEdges, LeavesPixelsAwayFromEdgesAndOtherObjectsAlone) {
  Picture picture = roof(0.4, 5);
  for (int y = 0; y < frameSide; ++y)
    for (int x = 12; x < frameSide; ++x) {
      picture.ids(x, y) = picture.styles(x, y) = 2;
      picture.r(x, y) = 0.5f;
    }
  picture.objects[2] = 2;
  const Floats before = picture.r.clone();
  picture.blend();
  int changed = 0;
  for (int y = 0; y < frameSide; ++y)
    for (int x = 0; x < frameSide; ++x) {
      changed += picture.r(x, y) != before(x, y);
      if (x >= 12) changed += 100 * (std::fabs(picture.r(x, y) - 0.5f) > 1e-6f);
    }
  EXPECT_GT(changed, 8);
  EXPECT_LT(changed, 60);
}

TEST(InnerEdges, BordersOfPaintAreEdges) {
  Picture picture{[](double, double) { return 0.0; }, [](double, double) { return 0.0; },
                  [](double x, double y) { return y > 6.2 + 0.4 * x; }};
  for (int y = 0; y < frameSide; ++y)
    for (int x = 0; x < frameSide; ++x) picture.styles(x, y) = picture.r(x, y) > 0 ? 2 : 1;
  picture.blend();
  EXPECT_LT(picture.error(), 0.12f);
}

TEST(InnerEdges, MirrorsExactly) {
  Picture picture = roof(0.37, 7.3);
  Picture mirrored{
      [](double x, double y) { return -2 * std::fabs(y - 7.3 - 0.37 * (frameSide - x)); },
      [](double x, double y) { return -1.5 * std::fabs(y - 7.3 - 0.37 * (frameSide - x)); },
      [](double x, double y) { return y - 7.3 - 0.37 * (frameSide - x) > 0; }};
  picture.blend();
  mirrored.blend();
  for (int y = 0; y < frameSide; ++y)
    for (int x = 0; x < frameSide; ++x)
      EXPECT_NEAR(picture.r(x, y), mirrored.r(frameSide - 1 - x, y), 1e-4f) << x << " " << y;
}

}  // namespace
}  // namespace kagefude
