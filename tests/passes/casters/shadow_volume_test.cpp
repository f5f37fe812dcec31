#include "passes/casters/shadow_volume.h"

#include <gtest/gtest.h>

#include <random>

#include "passes/casters/light_places.h"
#include "passes/traced_scene.h"

namespace kagefude {
namespace {

using test::pointAt;
using test::sunAlong;

void expectAgreement(const TracedScene& scene, const LightPlace& light) {
  const CasterSet casters = scene.casters();
  const Floats volume = shadowVolume(scene.seen(), scene.meshes, casters, light, {});
  const Floats coverage = shadowCoverage(scene.seen(), casters, light, {});
  int edges = 0;
  double sum = 0;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      if (scene.ids(x, y) == 0) continue;
      const double truth = scene.tracedCoverage(x, y, light);
      edges += truth > 0 && truth < 1;
      sum += std::fabs(volume(x, y) - truth);
      EXPECT_NEAR(volume(x, y), coverage(x, y), 6.5 / 64) << x << ' ' << y << " truth " << truth;
    }
  EXPECT_GT(edges, 40);
  EXPECT_LT(sum / edges, 0.5 / 64);
}

TEST(ShadowVolume, BoxOverTheGroundMatchesTraceAndCoverage) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0.7f}, {1, 1, 2})};
  scene.render();
  expectAgreement(scene, pointAt({-3, 2, 6}));
  expectAgreement(scene, sunAlong(V3d(0.5, 0.2, -1).normalized()));
}

TEST(ShadowVolume, OrthographicCamera) {
  TracedScene scene;
  scene.orthographic = true;
  scene.opening = 2.5;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0.7f}, {1, 1, 2})};
  scene.render();
  expectAgreement(scene, pointAt({-3, 2, 6}));
  expectAgreement(scene, sunAlong(V3d(0.5, 0.2, -1).normalized()));
}

TEST(ShadowVolume, CameraInsideAVolume) {
  TracedScene scene;
  scene.meshes = {groundMesh(1, 20),
                  quadMesh(2, {-4, -14, 8}, {4, -14, 8}, {4, -2, 8}, {-4, -2, 8})};
  scene.render();
  const LightPlace light = pointAt({0.3, -8, 16});
  ASSERT_TRUE(scene.hidden(scene.eye, light));
  expectAgreement(scene, light);
}

TEST(ShadowVolume, OpenSoupMatchesTheTrace) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-2.5f, 2.5f), size(-1.2f, 1.2f);
  TracedScene scene;
  CasterMesh soup{"soup", 0, {}, {}};
  for (uint32_t i = 0; i < 20; ++i) {
    const V3f centre(place(random), place(random), 9 + 0.2f * place(random));
    for (int corner = 0; corner < 3; ++corner)
      soup.vertices.push_back(centre + V3f(size(random), size(random), size(random)));
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  scene.meshes = {groundMesh(1)};
  scene.render();
  scene.meshes.push_back(soup);
  const LightPlace light = pointAt({0, 0, 20});
  const Floats volume = shadowVolume(scene.seen(), scene.meshes, scene.casters(), light, {});
  const Floats coverage = shadowCoverage(scene.seen(), scene.casters(), light, {});
  int edges = 0;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      EXPECT_NEAR(volume(x, y), coverage(x, y), 1.5 / 64) << x << ' ' << y;
      edges += coverage(x, y) > 0 && coverage(x, y) < 1;
    }
  EXPECT_GT(edges, 100);
}

TEST(ShadowVolume, SilhouetteOfABoxFromAboveIsItsRim) {
  const CasterMesh box = boxMesh(1, {-1, -1, 0}, {1, 1, 1});
  const auto edges = silhouetteEdges(box, pointAt({0, 0, 5}));
  ASSERT_EQ(edges.size(), 4u);
  for (const SilhouetteEdge& edge : edges) {
    // Both the front and the back of a closed mesh end here.
    EXPECT_EQ(edge.weight, 2);
    EXPECT_EQ(edge.a.z, 1.0f);
    EXPECT_EQ(edge.b.z, 1.0f);
    // Counter-clockwise seen from above: the shadow lies to the left.
    EXPECT_GT(edge.a.x * edge.b.y - edge.a.y * edge.b.x, 0.0f);
  }
}

TEST(ShadowVolume, SilhouetteOfAnOpenSheetIsItsBorder) {
  const CasterMesh quad = quadMesh(1, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1});
  for (const double height : {5.0, -5.0}) {
    const auto edges = silhouetteEdges(quad, pointAt({0, 0, height}));
    ASSERT_EQ(edges.size(), 4u);
    for (const SilhouetteEdge& edge : edges) EXPECT_EQ(edge.weight, 1);
  }
}

}  // namespace
}  // namespace kagefude
