#include "passes/casters/coverage.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <random>

#include "base/error.h"
#include "passes/casters/light_places.h"
#include "passes/traced_scene.h"

namespace kagefude {
namespace {

using test::pointAt;
using test::sunAlong;

struct Comparison {
  double worst = 0, sum = 0;
  int edges = 0, pixels = 0;
};

Comparison compare(const TracedScene& scene, const LightPlace& light, const Floats& coverage,
                   double gap = 1e-4) {
  Comparison result;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      if (scene.ids(x, y) == 0) continue;
      const double truth = scene.tracedCoverage(x, y, light, gap);
      const double error = std::fabs(truth - coverage(x, y));
      result.worst = std::max(result.worst, error);
      result.sum += error;
      ++result.pixels;
      result.edges += truth > 0 && truth < 1;
    }
  return result;
}

TEST(Coverage, RandomTrianglesMatchATrace) {
  for (int seed = 0; seed < 6; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<float> place(-2.5f, 2.5f), size(-1.2f, 1.2f);
    TracedScene scene;
    scene.orthographic = seed % 3 == 2;
    if (scene.orthographic) scene.opening = 4;
    scene.meshes = {groundMesh(1)};
    for (uint32_t k = 0; k < 3; ++k) {
      CasterMesh mesh{"soup", 2 + k, {}, {}};
      for (uint32_t i = 0; i < 12; ++i) {
        const V3f centre(place(random), place(random), 1.8f + 0.5f * place(random));
        for (int corner = 0; corner < 3; ++corner)
          mesh.vertices.push_back(centre + V3f(size(random), size(random), 0.5f * size(random)));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      }
      scene.meshes.push_back(mesh);
    }
    scene.render();
    const LightPlace light =
        seed % 2 ? sunAlong(V3d(0.4, 0.3, -1).normalized()) : pointAt({1.5, -2, 6});
    const Floats coverage = shadowCoverage(scene.seen(), scene.casters(), light, {});
    // The oracle asks for one small gap, the pass for a share of a pixel, so that sub-pixels
    // where triangles pierce each other may differ.
    const Comparison c = compare(scene, light, coverage);
    EXPECT_GT(c.edges, 100) << seed;
    EXPECT_LT(c.sum / c.edges, 1.0 / 64 / 4) << seed;
    EXPECT_LE(c.worst, 6.0 / 64) << seed;
  }
}

TEST(Coverage, BoxTouchingTheGroundHasNoGapAtTheContact) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0}, {1, 1, 1.5f})};
  scene.render();
  const LightPlace light = pointAt({-4, 2, 5});
  const Comparison c =
      compare(scene, light, shadowCoverage(scene.seen(), scene.casters(), light, {}));
  EXPECT_GT(c.edges, 60);
  EXPECT_LT(c.sum / c.edges, 0.2 / 64);
  EXPECT_LE(c.worst, 2.0 / 64);
}

TEST(Coverage, CastersBehindTheCameraAndCameraInsideTheVolume) {
  TracedScene scene;
  // A roof over and behind the camera: the eye is in its shadow.
  scene.meshes = {groundMesh(1, 20),
                  quadMesh(2, {-4, -14, 8}, {4, -14, 8}, {4, -2, 8}, {-4, -2, 8})};
  scene.render();
  const LightPlace light = pointAt({0.3, -8, 16});
  ASSERT_TRUE(scene.hidden(scene.eye, light));
  const Comparison c =
      compare(scene, light, shadowCoverage(scene.seen(), scene.casters(), light, {}));
  EXPECT_GT(c.edges, 20);
  EXPECT_LE(c.worst, 1.0 / 64);
}

TEST(Coverage, OwnObjectLeftOut) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0}, {1, 1, 2})};
  scene.render();
  const LightPlace light = pointAt({3, 5, 5});
  const Floats kept = shadowCoverage(scene.seen(), scene.casters(), light, {});
  const Floats without =
      shadowCoverage(scene.seen(), scene.casters(), light, {.selfShadow = false});
  int shadedSelf = 0;
  for (int y = 1; y + 1 < scene.height; ++y)
    for (int x = 1; x + 1 < scene.width; ++x) {
      bool alone = true;
      for (int k = 0; k < 9; ++k)
        alone &= scene.ids(x + k % 3 - 1, y + k / 3 - 1) == scene.ids(x, y);
      if (!alone) continue;
      if (scene.ids(x, y) == 2) {
        shadedSelf += kept(x, y) == 1.0f;
        EXPECT_EQ(without(x, y), 0.0f);
      } else {
        EXPECT_EQ(without(x, y), kept(x, y));
      }
    }
  EXPECT_GT(shadedSelf, 20);
}

TEST(Coverage, MaskAtCentresMatchesATrace) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0.5f}, {1, 1, 2})};
  scene.render();
  const LightPlace light = pointAt({-3, 2, 6});
  const Bytes mask = hardShadowMask(scene.seen(), scene.casters(), light, {});
  int hidden = 0;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const V3d lifted =
          V3d(scene.position.view()(x, y)) +
          V3d(scene.normal.view()(x, y)) *
              (scene.normal.view()(x, y).dot(V3f(scene.rays.direction(x, y))) > 0 ? -1e-4 : 1e-4);
      const bool dark = scene.ids(x, y) != 0 && scene.hidden(lifted, light);
      EXPECT_EQ(mask(x, y), dark ? 0 : 1) << x << ' ' << y;
      hidden += dark;
    }
  EXPECT_GT(hidden, 100);
}

TEST(Coverage, MaskOfManySmallTrianglesMatchesATrace) {
  TracedScene scene;
  CasterMesh sheet{"sheet", 2, {}, {}};
  constexpr uint32_t side = 40;
  for (uint32_t i = 0; i < side; ++i)
    for (uint32_t j = 0; j < side; ++j) {
      const float x = 0.05f * float(i) - 1, y = 0.05f * float(j) - 1;
      sheet.vertices.push_back({x, y, 1.2f + 0.2f * std::sin(9 * x) * std::sin(7 * y)});
      if (i > 0 && j > 0 && (i + j) % 5 != 0) {
        const uint32_t at = i * side + j;
        sheet.triangles.push_back({at, at - 1, at - side});
        sheet.triangles.push_back({at - side, at - 1, at - side - 1});
      }
    }
  scene.meshes = {groundMesh(1), sheet};
  scene.render();
  const LightPlace light = pointAt({-2, 1, 5});
  const Bytes mask = hardShadowMask(scene.seen(), scene.casters(), light, {});
  int hidden = 0, differ = 0;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      if (scene.ids(x, y) != 1) continue;
      const V3d lifted = V3d(scene.position.view()(x, y)) + V3d(0, 0, 1e-4);
      const bool dark = scene.hidden(lifted, light);
      differ += mask(x, y) != (dark ? 0 : 1);
      hidden += dark;
    }
  EXPECT_GT(hidden, 50);
  EXPECT_EQ(differ, 0);
}

TEST(Coverage, ReceiverThatIsNoCasterTakesItsPlaneFromTheNormal) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 1}, {1, 1, 2})};
  scene.render();
  const LightPlace light = pointAt({-2, 2, 6});
  const std::vector<CasterMesh> boxOnly = {scene.meshes[1]};
  const Floats coverage = shadowCoverage(scene.seen(), CasterSet(boxOnly), light, {});
  const Comparison c = compare(scene, light, coverage);
  EXPECT_GT(c.edges, 60);
  EXPECT_LT(c.sum / c.edges, 0.5 / 64);
}

TEST(Coverage, BadMeshesGiveWhatTheirGoodTrianglesGive) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 1}, {1, 1, 2})};
  scene.render();
  const LightPlace light = pointAt({-2, 2, 6});
  const Floats good = shadowCoverage(scene.seen(), scene.casters(), light, {});
  CasterMesh bad = scene.meshes[1];
  bad.vertices.push_back(V3f(std::numeric_limits<float>::quiet_NaN()));
  bad.triangles.push_back({0, 1, 8});
  bad.triangles.push_back({0, 1, 77});
  bad.triangles.push_back({0, 0, 1});
  const CasterFaults faults = cleanCasterMesh(bad);
  EXPECT_EQ(faults.nonFinite, 1u);
  EXPECT_EQ(faults.badIndices, 1u);
  EXPECT_EQ(faults.degenerate, 1u);
  EXPECT_EQ(faults.openEdges, 0u);
  EXPECT_NE(faultWarning(bad, faults), "");
  const std::vector<CasterMesh> meshes = {scene.meshes[0], bad, CasterMesh{"empty", 9, {}, {}}};
  const Floats same = shadowCoverage(scene.seen(), CasterSet(meshes), light, {});
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) ASSERT_EQ(good(x, y), same(x, y));
}

TEST(Coverage, NoCastersAndBackgroundAndLightOnATriangle) {
  TracedScene scene;
  scene.meshes = {groundMesh(1, 2)};
  scene.render();
  const Floats none = shadowCoverage(scene.seen(), CasterSet(), pointAt({0, 0, 3}), {});
  const Floats onGround = shadowCoverage(scene.seen(), scene.casters(), pointAt({0, 0, 0}), {});
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      ASSERT_EQ(none(x, y), 0.0f);
      ASSERT_EQ(onGround(x, y), 0.0f);
    }
}

TEST(Coverage, SameBitsForAnyNumberOfThreads) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0}, {1, 1, 2})};
  scene.render();
  const CasterSet casters = scene.casters();
  const LightPlace light = pointAt({-2, 2, 6});
  const Floats many = shadowCoverage(scene.seen(), casters, light, {});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Floats single = shadowCoverage(scene.seen(), casters, light, {});
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) ASSERT_EQ(many(x, y), single(x, y));
}

TEST(Coverage, PlanesOfDifferentSizeAreRefused) {
  TracedScene scene;
  scene.meshes = {groundMesh(1)};
  scene.render();
  SeenSurface seen = scene.seen();
  const Labels small(4, 4, 1u);
  seen.ids = small;
  EXPECT_THROW(shadowCoverage(seen, scene.casters(), pointAt({0, 0, 3}), {}), InputError);
}

TEST(Coverage, VisibilityIsOneMinusStrengthTimesCoverage) {
  Floats coverage(2, 1);
  coverage(0, 0) = 0.25f;
  coverage(1, 0) = 1.0f;
  coverageToVisibility(coverage, {.strength = 0.5f});
  EXPECT_EQ(coverage(0, 0), 0.875f);
  EXPECT_EQ(coverage(1, 0), 0.5f);
}

}  // namespace
}  // namespace kagefude
