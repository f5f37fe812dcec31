#include "passes/casters/planar_projection.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "passes/casters/light_places.h"
#include "passes/traced_scene.h"

namespace kagefude {
namespace {

using test::pointAt;
using test::sunAlong;

TEST(PlanarProjection, PointLightDoublesAtHalfHeightByHand) {
  const std::vector<CasterMesh> casters = {
      quadMesh(2, {-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2})};
  const auto flat = projectedOnPlane(casters, {}, pointAt({0, 0, 4}));
  ASSERT_EQ(flat.size(), 1u);
  for (const V3f& p : flat[0].vertices) {
    EXPECT_FLOAT_EQ(std::fabs(p.x), 2);
    EXPECT_FLOAT_EQ(std::fabs(p.y), 2);
    EXPECT_NEAR(p.z, 0, 1e-6);
  }
}

TEST(PlanarProjection, SunShiftsByHeightTimesSlopeByHand) {
  const std::vector<CasterMesh> casters = {quadMesh(2, {0, 0, 3}, {1, 0, 3}, {1, 1, 3}, {0, 1, 3})};
  const auto flat = projectedOnPlane(casters, {}, sunAlong({0.5, 0, -1}));
  float low = 100, high = -100;
  for (const V3f& p : flat[0].vertices) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  EXPECT_NEAR(low, 1.5, 1e-5);
  EXPECT_NEAR(high, 2.5, 1e-5);
}

TEST(PlanarProjection, BeyondThePlaneOrTheLightNothingIsProjected) {
  const std::vector<CasterMesh> casters = {
      quadMesh(2, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}),
      quadMesh(3, {-1, -1, 9}, {1, -1, 9}, {1, 1, 9}, {-1, 1, 9})};
  for (const CasterMesh& mesh : projectedOnPlane(casters, {}, pointAt({0, 0, 4})))
    EXPECT_TRUE(mesh.triangles.empty()) << mesh.id;
  EXPECT_TRUE(projectedOnPlane(casters, {}, sunAlong({1, 0, 0})).empty());
}

TEST(PlanarProjection, ACasterThroughThePlaneKeepsItsUpperPart) {
  const std::vector<CasterMesh> casters = {
      quadMesh(2, {0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1})};
  const auto flat = projectedOnPlane(casters, {}, sunAlong({1, 0, -1}));
  for (const V3f& p : flat[0].vertices) {
    EXPECT_GE(p.x, -1e-6);
    EXPECT_LE(p.x, 1 + 1e-6);
  }
  EXPECT_FALSE(flat[0].triangles.empty());
}

TEST(PlanarProjection, MatchesTheTraceOnTheReceiver) {
  for (const bool orthographic : {false, true}) {
    TracedScene scene;
    scene.orthographic = orthographic;
    if (orthographic) scene.opening = 4;
    scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 1}, {1, 1, 2})};
    scene.render();
    const LightPlace light = pointAt({-3, 2, 6});
    const ReceiverPlane plane = planeOfReceiver(scene.seen(), 1, "Ground");
    EXPECT_NEAR(std::fabs(plane.normal.z), 1, 1e-6);
    const Floats shadow =
        planarShadow(scene.seen(), 1, plane, scene.meshes, scene.casters(), light, {.alpha = 0.5f});
    int hidden = 0;
    for (int y = 1; y + 1 < scene.height; ++y)
      for (int x = 1; x + 1 < scene.width; ++x) {
        bool alone = true;
        for (int k = 0; k < 9; ++k) alone &= scene.ids(x + k % 3 - 1, y + k / 3 - 1) == 1;
        if (scene.ids(x, y) == 2) {
          EXPECT_EQ(shadow(x, y), 0.0f);
        }
        if (!alone) continue;
        EXPECT_NEAR(shadow(x, y), 0.5 * scene.tracedCoverage(x, y, light), 1.0 / 64);
        hidden += shadow(x, y) == 0.5f;
      }
    EXPECT_GT(hidden, 50) << "overlapping faces of the box must not darken twice";
  }
}

TEST(PlanarProjection, ABoxThatStandsOnTheReceiverDoesNotDarkenItsOutline) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0}, {1, 1, 1.5f})};
  scene.render();
  const LightPlace light = pointAt({-4, 2, 5});
  const Floats shadow = planarShadow(scene.seen(), 1, planeOfReceiver(scene.seen(), 1, "Ground"),
                                     scene.meshes, scene.casters(), light, {.alpha = 1.0f});
  int outline = 0;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      if (scene.ids(x, y) != 1) continue;
      int shown = 0, dark = 0;
      for (int k = 0; k < 64; ++k) {
        const double u = x + (k % 8 + 0.5) / 8, v = y + (k / 8 + 0.5) / 8;
        const V3d o = scene.eye + scene.rays.origin(u, v), d = scene.rays.direction(u, v);
        const auto hit = scene.nearest(o, d);
        if (!hit || hit->id != 1) continue;
        ++shown;
        dark += scene.hidden(TracedScene::lifted(o, d, *hit, 1e-5), light);
      }
      EXPECT_NEAR(shadow(x, y), double(dark) / shown, 2.5 / 64) << x << ' ' << y;
      outline += shown < 64 && dark == 0;
    }
  EXPECT_GT(outline, 5);
}

TEST(PlanarProjection, AReceiverThatIsNotFlatOrNotThereIsRefused) {
  TracedScene scene;
  scene.meshes = {groundMesh(1), boxMesh(2, {-1, -1, 0}, {1, 1, 2})};
  scene.render();
  EXPECT_THROW(planeOfReceiver(scene.seen(), 2, "Box"), InputError);
  EXPECT_THROW(planeOfReceiver(scene.seen(), 7, "Table"), InputError);
}

}  // namespace
}  // namespace kagefude
