#include "passes/depth_map/pcf.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "passes/depth_map/map_taps.h"
#include "passes/random_image.h"

namespace kagefude {
namespace {

using test::equalBits;

Transform orthographic(double halfWidth) {
  Transform t;
  t.m[0][0] = t.m[1][1] = 1 / halfWidth;
  t.m[2][2] = -0.01;
  return t;
}

/// Clip w = -z, 45 degrees to each side.
Transform perspective() {
  Transform t;
  t.m[2][2] = -1;
  t.m[2][3] = -0.2;
  t.m[3][2] = -1;
  t.m[3][3] = 0;
  return t;
}

/// A light at (0, 0, 10) that looks down on receivers near z = 0.
Transform lightFromWorld() {
  Transform t;
  t.m[2][3] = -10;
  return t;
}

/// One row of pixels on a plane through the origin, x from -extent to extent.
struct Receivers {
  Vec3Plane position, normal;
  Labels labels;

  Receivers(int count, float extent, float slope)
      : position(count, 1), normal(count, 1), labels(count, 1, 1) {
    const V3f n = V3f(-slope, 0, 1).normalized();
    for (int i = 0; i < count; ++i) {
      const float x = extent * (2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 1);
      position.set(i, 0, V3f(x, 0.013f, slope * x));
      normal.set(i, 0, n);
    }
  }
  Floats visibility(const ShadowMap& map, const PcfParams& params = {}) const {
    return pcfVisibility(position, normal, labels, map, params);
  }
};

/// Depth of the plane z = slope·x seen from the light, at texel centres.
Floats planeMap(int size, bool inPerspective, double halfWidth, double slope) {
  Floats depth(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double nx = 2 * (x + 0.5) / size - 1;
      depth(x, y) =
          static_cast<float>(inPerspective ? 10 / (1 + slope * nx) : 10 - slope * nx * halfWidth);
    }
  return depth;
}

TEST(Pcf, ShareOfLitTapsByHand) {
  // Light from straight above; the half x < 0 of the map holds a blocker at depth 4. A disc whose
  // centre lies on the edge sees about half of the light, one beyond its radius all or nothing.
  Floats depth(64, 64, 10.0f);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 32; ++x) depth(x, y) = 4;
  const ShadowMap map{depth, lightFromWorld(), orthographic(32)};
  const Receivers r(3, 24, 0);
  PcfParams params;
  params.radius = 8;
  const Floats v = r.visibility(map, params);
  EXPECT_EQ(v(0, 0), 0.0f);
  EXPECT_NEAR(v(1, 0), 0.5f, 1.5f / 32);
  EXPECT_EQ(v(2, 0), 1.0f);
}

TEST(Pcf, DiscIsSampledByArea) {
  // Share of a disc beyond an edge at half its radius: 1/2 + (d√(1-d²) + asin d)/π with d = 1/2.
  Floats depth(256, 256, 10.0f);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 128; ++x) depth(x, y) = 4;
  const ShadowMap map{depth, lightFromWorld(), orthographic(128)};
  Receivers r(1, 1, 0);
  r.position.set(0, 0, V3f(16, 0, 0));
  PcfParams params;
  params.radius = 32;
  params.samples = 256;
  const double d = 0.5, share = 0.5 + (d * std::sqrt(1 - d * d) + std::asin(d)) / M_PI;
  EXPECT_NEAR(r.visibility(map, params)(0, 0), share, 0.02);
}

TEST(Pcf, NoAcneOnSlopes) {
  for (const bool inPerspective : {false, true})
    for (const float slope : {0.0f, 0.7f, -2.5f}) {
      const Floats depth = planeMap(64, inPerspective, 10, slope);
      const ShadowMap map{depth, lightFromWorld(),
                          inPerspective ? perspective() : orthographic(10)};
      const Receivers r(97, 2.5f, slope);
      PcfParams params;
      params.radius = 4;
      params.bias = 0.01f;
      const Floats v = r.visibility(map, params);
      for (int i = 0; i < 97; ++i)
        ASSERT_EQ(v(i, 0), 1.0f) << inPerspective << slope << " at " << i;
    }
}

TEST(Pcf, WithoutSlopeBiasTheSameSlopeHasAcne) {
  const Floats depth = planeMap(64, false, 10, -2.5);
  const ShadowMap map{depth, lightFromWorld(), orthographic(10)};
  PcfParams params;
  params.radius = 4;
  params.slope_bias = 0;
  EXPECT_LT(Receivers(97, 2.5f, -2.5f).visibility(map, params)(40, 0), 1.0f);
}

TEST(Pcf, ThePlaneDoesNotLeakThroughABlocker) {
  Floats depth = planeMap(64, false, 10, 0.7);
  for (int y = 0; y < 64; ++y)
    for (int x = 20; x < 44; ++x) depth(x, y) -= 1.0f;
  const ShadowMap map{depth, lightFromWorld(), orthographic(10)};
  EXPECT_EQ(Receivers(5, 1, 0.7f).visibility(map)(2, 0), 0.0f);
}

TEST(Pcf, TexelsPerUnitAtTheReceiver) {
  const Floats depth(64, 64, 10.0f);
  const ShadowMap map{depth, lightFromWorld(), perspective()};
  Receivers r(1, 0, 0);
  r.position.set(0, 0, V3f(0, 0, 0));
  MapReceivers found;
  MapProjector(map).receive(r.position, r.normal, r.labels, 0, 0, 1, found);
  EXPECT_EQ(found.visibility[0], MapReceivers::open);
  EXPECT_FLOAT_EQ(found.depth[0], 10);
  EXPECT_FLOAT_EQ(found.texelsPerUnit[0], 3.2f) << "64 texels over 20 units at depth 10";
}

TEST(MapReceivers, SlopesFollowThePlaneOverTheMap) {
  // The plane's depth at another of its points must be what the slopes say; off-axis too.
  for (const bool inPerspective : {false, true}) {
    Transform clip = inPerspective ? perspective() : orthographic(9);
    if (inPerspective) clip.m[0][2] = 0.3;
    const Floats depth(64, 48, 10.0f);
    const ShadowMap map{depth, lightFromWorld(), clip};
    const V3f n = V3f(0.3f, -0.5f, 0.8f), along = n.cross(V3f(1, 2, 0)) * 0.3f;
    Vec3Plane position(2, 1), normal(2, 1);
    for (int i = 0; i < 2; ++i) {
      position.set(i, 0, V3f(0.5f, -1, 0.25f) + along * static_cast<float>(i));
      normal.set(i, 0, n);
    }
    MapReceivers r;
    const Labels labels(2, 1, 1u);
    MapProjector(map).receive(position, normal, labels, 0, 0, 2, r);
    const float du = r.u[1] - r.u[0], dv = r.v[1] - r.v[0];
    const float planes =
        inPerspective ? r.planeDepth<true>(0, du, dv, 1) : r.planeDepth<false>(0, du, dv, 1);
    EXPECT_NEAR(planes, r.depth[1], 1e-4f);
    EXPECT_GT(std::fabs(r.depth[1] - r.depth[0]), 0.1f) << "the points must differ in depth";
  }
}

TEST(Pcf, OutsideTheMapBehindTheLightAndBackgroundAreLit) {
  const Floats depth(8, 8, 0.5f);
  const ShadowMap map{depth, lightFromWorld(), perspective()};
  Receivers r(4, 1, 0);
  r.position.set(0, 0, V3f(300, 0, 0));
  r.position.set(1, 0, V3f(0, 0, 11));
  r.position.set(2, 0, V3f(std::numeric_limits<float>::quiet_NaN(), 0, 0));
  Floats v = r.visibility(map);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(v(i, 0), 1.0f) << i;
  EXPECT_EQ(v(3, 0), 0.0f);
  r.labels(3, 0) = 0;
  EXPECT_EQ(r.visibility(map)(3, 0), 1.0f);
}

TEST(Pcf, ASurfaceTurnedAwayIsHidden) {
  const Floats depth(8, 8, 100.0f);
  Receivers r(1, 0.1f, 0);
  for (const Transform& clip : {perspective(), orthographic(9)}) {
    const ShadowMap map{depth, lightFromWorld(), clip};
    r.normal.set(0, 0, V3f(0, 0, -1));
    EXPECT_EQ(r.visibility(map)(0, 0), 0.0f);
    r.normal.set(0, 0, V3f(0, 0, 0));
    EXPECT_EQ(r.visibility(map)(0, 0), 1.0f) << "an unknown normal turns nowhere";
  }
}

TEST(Pcf, SpreadBiasLightsHollows) {
  // Around the pixel the surface rises by a fifth of the distance.
  Floats depth(65, 65);
  for (int y = 0; y < 65; ++y)
    for (int x = 0; x < 65; ++x) depth(x, y) = 10 - 0.2f * std::hypot(x - 32.0f, y - 32.0f);
  const ShadowMap map{depth, lightFromWorld(), orthographic(32.5)};
  Receivers r(1, 1, 0);
  r.position.set(0, 0, V3f(0, 0, 0));
  PcfParams params;
  params.radius = 10;
  params.spread_bias = 0;
  EXPECT_LT(r.visibility(map, params)(0, 0), 0.5f);
  params.spread_bias = 0.25f;
  EXPECT_EQ(r.visibility(map, params)(0, 0), 1.0f);
}

TEST(Pcf, NanDepthIsLit) {
  const Floats depth(8, 8, std::numeric_limits<float>::quiet_NaN());
  const ShadowMap map{depth, lightFromWorld(), perspective()};
  EXPECT_EQ(Receivers(1, 0.1f, 0).visibility(map)(0, 0), 1.0f);
}

TEST(Pcf, ThePyramidChangesNoBitAndThreadsChangeNone) {
  Floats depth = test::randomFloats(90, 70, 4);
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 90; ++x) depth(x, y) = (x / 20 + y / 20) % 2 ? 12 : 9.8f + depth(x, y);
  Receivers r(1, 1, 0);
  r.position = Vec3Plane(160, 120);
  r.normal = Vec3Plane(160, 120);
  r.labels = test::randomLabels(160, 120, 3, 20, 3);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      r.position.set(x, y, V3f(x / 8.0f - 10, y / 6.0f - 10, 0.2f * std::sin(x * 0.1f)));
      r.normal.set(x, y, V3f(-0.2f * std::cos(x * 0.1f), 0.1f, 1));
    }
  for (const bool inPerspective : {false, true})
    for (const float radius : {0.0f, 1.5f, 9.0f}) {
      const ShadowMap map{depth, lightFromWorld(), inPerspective ? perspective() : orthographic(9)};
      PcfParams params;
      params.radius = radius;
      const Floats taps = detail::pcfVisibilityByTaps(r.position, r.normal, r.labels, map, params);
      EXPECT_TRUE(equalBits<float>(r.visibility(map, params), taps));
      for (const size_t threads : {1, 2, 4}) {
        tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_TRUE(equalBits<float>(r.visibility(map, params), taps)) << threads;
      }
    }
}

TEST(DepthPyramid, TwoNodesInEachDirectionBoundEveryRun) {
  const Floats depth = test::randomFloats(37, 22, 8);
  const DepthPyramid pyramid(depth);
  for (int side = 1; side < 60; side += 3) {
    const DepthPyramid::Level level = pyramid.levelFor(side);
    for (int y0 = 0; y0 < 22; y0 += 3)
      for (int x0 = 0; x0 < 37; x0 += 2) {
        const int x1 = std::min(x0 + side - 1, 36), y1 = std::min(y0 + side - 1, 21);
        ASSERT_LE((x1 >> level.shift) - (x0 >> level.shift), 1);
        for (int y = y0; y <= y1; ++y)
          for (int x = x0; x <= x1; ++x) {
            ASSERT_LE(level.nearest(x >> level.shift, y >> level.shift), depth(x, y));
            ASSERT_GE(level.farthest(x >> level.shift, y >> level.shift), depth(x, y));
          }
      }
  }
  EXPECT_EQ(pyramid.whole().nearest, *std::min_element(depth.row(0), depth.row(22)));
}

TEST(DepthPyramid, NanCountsAsInfinitelyFar) {
  Floats depth(3, 1, 2.0f);
  depth(1, 0) = std::numeric_limits<float>::quiet_NaN();
  const DepthRange whole = DepthPyramid(depth).whole();
  EXPECT_EQ(whole.nearest, 2.0f);
  EXPECT_EQ(whole.farthest, std::numeric_limits<float>::infinity());
}

TEST(Pcf, RefusesPlanesOfOtherSizesAndAnEmptyMap) {
  const Floats depth(8, 8, 1.0f);
  const Receivers r(4, 1, 0);
  const Labels labels(3, 1, 1);
  const ShadowMap map{depth, {}, perspective()};
  EXPECT_THROW(pcfVisibility(r.position, r.normal, labels, map, {}), InputError);
  EXPECT_THROW(r.visibility({{}, {}, perspective()}), InputError);
}

}  // namespace
}  // namespace kagefude
