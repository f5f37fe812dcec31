// Shadows on a map of whole units, whose coverage is a fraction that one can see.
#include <gtest/gtest.h>

#include <limits>

#include "passes/casters/coverage.h"
#include "passes/casters/light_places.h"
#include "passes/casters/shadow_volume.h"
#include "passes/traced_scene.h"

namespace kagefude {
namespace {

using test::sunAlong;

/// Looks straight down on the ground with pixels of one unit; pixel (i, j) spans x in [i, i+1],
/// y from 16 - j down.
TracedScene flatMap() {
  TracedScene scene;
  scene.eye = {8, 8, 30};
  scene.target = {8, 8, 0};
  scene.orthographic = true;
  scene.width = scene.height = 16;
  scene.opening = 8;
  scene.meshes = {quadMesh(1, {-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0})};
  return scene;
}

/// render() keeps z up, which a camera that looks straight down has no use for.
void renderDown(TracedScene& scene) {
  scene.eye.y -= 1e-9;
  scene.render();
}

TEST(Coverage, SquareUnderAnOverheadSunByHand) {
  TracedScene scene = flatMap();
  // Covers x 4..8.5 and y 4..8.25: whole pixels, half pixels, quarter pixels, and an eighth.
  scene.meshes.push_back(quadMesh(0, {4, 4, 1}, {8.5f, 4, 1}, {8.5f, 8.25f, 1}, {4, 8.25f, 1}));
  renderDown(scene);
  scene.ids.fill(1);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) scene.position.z(x, y) = 0;
  // The square itself is unseen by the camera: only the ground is in the picture.
  const Floats c = shadowCoverage(scene.seen(), scene.casters(), sunAlong({0, 0, -1}), {});
  EXPECT_EQ(c(5, 16 - 1 - 5), 1.0f);
  EXPECT_EQ(c(8, 16 - 1 - 5), 0.5f);
  EXPECT_EQ(c(5, 16 - 1 - 8), 0.25f);
  EXPECT_EQ(c(8, 16 - 1 - 8), 0.125f);
  EXPECT_EQ(c(9, 16 - 1 - 5), 0.0f);
  EXPECT_EQ(c(3, 16 - 1 - 5), 0.0f);
}

/// The ground alone in the picture, and casters that the camera does not see.
TracedScene mapWith(const std::vector<CasterMesh>& unseen) {
  TracedScene scene = flatMap();
  renderDown(scene);
  scene.meshes.insert(scene.meshes.end(), unseen.begin(), unseen.end());
  return scene;
}

CasterMesh square(float z) {
  return quadMesh(0, {4, 4, z}, {8.5f, 4, z}, {8.5f, 8.25f, z}, {4, 8.25f, z});
}

/// What a square over x 4..8.5, y 4..8.25 throws straight down.
void expectSquaresShadow(const Floats& c) {
  EXPECT_EQ(c(5, 16 - 1 - 5), 1.0f);
  EXPECT_EQ(c(8, 16 - 1 - 5), 0.5f);
  EXPECT_EQ(c(5, 16 - 1 - 8), 0.25f);
  EXPECT_EQ(c(8, 16 - 1 - 8), 0.125f);
  EXPECT_EQ(c(9, 16 - 1 - 5), 0.0f);
  EXPECT_EQ(c(3, 16 - 1 - 5), 0.0f);
  EXPECT_EQ(c(5, 16 - 1 - 9), 0.0f);
}

Floats underOverheadSun(const TracedScene& scene) {
  return shadowCoverage(scene.seen(), scene.casters(), sunAlong({0, 0, -1}), {});
}

TEST(Coverage, CasterBehindTheCameraWhichItShadesByHand) {
  const TracedScene scene = mapWith({square(40)});
  ASSERT_GT(40, scene.eye.z);
  ASSERT_TRUE(scene.hidden(scene.eye, sunAlong({0, 0, -1}))) << "the camera is inside the volume";
  expectSquaresShadow(underOverheadSun(scene));
  expectSquaresShadow(
      shadowVolume(scene.seen(), scene.meshes, scene.casters(), sunAlong({0, 0, -1}), {}));
}

TEST(Coverage, BoxInContactWithTheGroundByHand) {
  TracedScene scene = flatMap();
  scene.meshes.push_back(boxMesh(2, {4, 4, 0}, {8, 8, 1.5f}));
  renderDown(scene);
  // Thrown 1.5 to the right, from the box's very foot.
  const Floats c =
      shadowCoverage(scene.seen(), scene.casters(), sunAlong(V3d(1, 0, -1).normalized()), {});
  EXPECT_EQ(c(8, 16 - 1 - 5), 1.0f);
  EXPECT_EQ(c(9, 16 - 1 - 5), 0.5f);
  EXPECT_EQ(c(10, 16 - 1 - 5), 0.0f);
  EXPECT_EQ(c(7, 16 - 1 - 5), 0.0f) << "the box's lit top";
  EXPECT_EQ(c(3, 16 - 1 - 5), 0.0f) << "the ground on the light's side";
}

TEST(Coverage, TwoHundredThousandTrianglesByHand) {
  constexpr uint32_t side = 320;
  CasterMesh sheet{"sheet", 0, {}, {}};
  for (uint32_t j = 0; j <= side; ++j)
    for (uint32_t i = 0; i <= side; ++i)
      sheet.vertices.push_back(
          {4 + 4.5f * float(i) / side, 4 + 4.25f * float(j) / side, 1 + 0.2f * float((i + j) % 2)});
  for (uint32_t j = 0; j < side; ++j)
    for (uint32_t i = 0; i < side; ++i) {
      const uint32_t a = j * (side + 1) + i;
      sheet.triangles.push_back({a, a + 1, a + side + 2});
      sheet.triangles.push_back({a, a + side + 2, a + side + 1});
    }
  ASSERT_GT(sheet.triangles.size(), 200000u);
  expectSquaresShadow(underOverheadSun(mapWith({sheet})));
}

/// A ridge along y at x = 8 with the light low on the right: the left slope turns away from it.
TEST(Coverage, SlopeTurnedFromTheLightIsDarkUpToTheRidge) {
  TracedScene scene = flatMap();
  scene.meshes.push_back(
      {"ridge",
       2,
       {{4, -9, 0}, {4, 25, 0}, {8, -9, 2}, {8, 25, 2}, {12, -9, 0}, {12, 25, 0}},
       {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}}});
  renderDown(scene);
  const LightPlace light = sunAlong(V3d(-1, 0, -0.2).normalized());
  // Lifted far enough to look over the ridge.
  const CoverageParams lifted{.bias = 0.3f};
  const Floats c = shadowCoverage(scene.seen(), scene.casters(), light, lifted);
  const Floats v = shadowVolume(scene.seen(), scene.meshes, scene.casters(), light, {.bias = 0.3f});
  for (int x = 4; x < 12; ++x) {
    EXPECT_EQ(c(x, 5), x < 8 ? 1.0f : 0.0f) << x;
    EXPECT_EQ(v(x, 5), x < 8 ? 1.0f : 0.0f) << x;
  }
  const Floats without =
      shadowCoverage(scene.seen(), scene.casters(), light, {.selfShadow = false, .bias = 0.3f});
  EXPECT_EQ(without(7, 5), 0.0f);
}

TEST(Coverage, OpenMeshThrowsTheShadowOfItsSheet) {
  CasterMesh sheet = square(1);
  const CasterFaults faults = cleanCasterMesh(sheet);
  EXPECT_EQ(faults.openEdges, 4u);
  EXPECT_EQ(faults.dropped(), 0u);
  expectSquaresShadow(underOverheadSun(mapWith({sheet})));
}

TEST(Coverage, NonManifoldMeshThrowsTheUnionOfItsSheets) {
  CasterMesh fan = square(1);
  // A third and a fourth triangle on the square's diagonal.
  fan.vertices.push_back({8, 5, 1.5f});
  fan.vertices.push_back({5, 8, 2.0f});
  fan.triangles.push_back({0, 2, 4});
  fan.triangles.push_back({2, 0, 5});
  const CasterFaults faults = cleanCasterMesh(fan);
  EXPECT_EQ(faults.nonManifoldEdges, 1u);
  EXPECT_EQ(faults.dropped(), 0u);
  const TracedScene scene = mapWith({fan});
  expectSquaresShadow(underOverheadSun(scene));
  expectSquaresShadow(
      shadowVolume(scene.seen(), scene.meshes, scene.casters(), sunAlong({0, 0, -1}), {}));
}

TEST(Coverage, DegenerateTrianglesAreDroppedWithAWarning) {
  CasterMesh mesh = square(1);
  mesh.triangles.push_back({0, 0, 1});
  mesh.vertices.push_back({40, 40, 1});
  mesh.vertices.push_back({60, 60, 1});
  mesh.vertices.push_back({80, 80, 1});
  mesh.triangles.push_back({4, 5, 6});
  const CasterFaults faults = cleanCasterMesh(mesh);
  EXPECT_EQ(faults.degenerate, 2u);
  EXPECT_NE(faultWarning(mesh, faults).find("2 have no area"), std::string::npos);
  expectSquaresShadow(underOverheadSun(mapWith({mesh})));
}

TEST(Coverage, NonFiniteTrianglesAreDroppedWithAWarning) {
  CasterMesh mesh = square(1);
  mesh.vertices.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 1});
  mesh.vertices.push_back({0, -std::numeric_limits<float>::infinity(), 1});
  mesh.triangles.push_back({0, 1, 4});
  mesh.triangles.push_back({0, 1, 5});
  const CasterFaults faults = cleanCasterMesh(mesh);
  EXPECT_EQ(faults.nonFinite, 2u);
  EXPECT_NE(faultWarning(mesh, faults).find("2 are not finite"), std::string::npos);
  expectSquaresShadow(underOverheadSun(mapWith({mesh})));
}

TEST(Coverage, EmptyMeshThrowsNoShadow) {
  CasterMesh empty{"empty", 0, {}, {}};
  EXPECT_EQ(faultWarning(empty, cleanCasterMesh(empty)), "");
  expectSquaresShadow(underOverheadSun(mapWith({empty, square(1)})));
  TracedScene scene = mapWith({});
  scene.meshes = {empty};
  EXPECT_EQ(underOverheadSun(scene)(5, 10), 0.0f);
}

TEST(Coverage, OverlapsAreCountedOnce) {
  TracedScene scene = flatMap();
  for (float z : {1.0f, 2.0f, 3.0f})
    scene.meshes.push_back(quadMesh(0, {4, 4, z}, {8.5f, 4, z}, {8.5f, 8, z}, {4, 8, z}));
  renderDown(scene);
  scene.ids.fill(1);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) scene.position.z(x, y) = 0;
  const Floats c = shadowCoverage(scene.seen(), scene.casters(), sunAlong({0, 0, -1}), {});
  EXPECT_EQ(c(8, 16 - 1 - 5), 0.5f);
}

}  // namespace
}  // namespace kagefude
