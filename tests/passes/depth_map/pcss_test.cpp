#include "passes/depth_map/pcss.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "passes/depth_map/pcf.h"

namespace kagefude {
namespace {

/// A floor at z = 0 under a light at (0, 0, 10) with a blocker at depth `blocker` over x < 0.
struct Scene {
  static constexpr int count = 400;
  Floats depth{256, 256, 10.0f};
  Vec3Plane position{count, 1}, normal{count, 1};
  Labels labels{count, 1, 1u};
  ShadowMap map;

  explicit Scene(float blocker) {
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 128; ++x) depth(x, y) = blocker;
    for (int i = 0; i < count; ++i) {
      position.set(i, 0, V3f(8.0f * (static_cast<float>(i) + 0.5f) / count - 4, 0, 0));
      normal.set(i, 0, V3f(0, 0, 1));
    }
    map.depth = depth;
    map.lightFromWorld.m[2][3] = -10;
    map.clipFromLight.m[2][2] = -1;
    map.clipFromLight.m[2][3] = -0.2;
    map.clipFromLight.m[3][2] = -1;
    map.clipFromLight.m[3][3] = 0;
  }
  Floats visibility(float radius) const {
    return pcssVisibility(position, normal, labels, map, radius, {});
  }
  /// World width of what is neither dark nor lit.
  float penumbra(float radius) const {
    const Floats v = visibility(radius);
    int between = 0;
    for (int x = 0; x < count; ++x) between += v(x, 0) > 0.02f && v(x, 0) < 0.98f;
    return 8.0f * static_cast<float>(between) / count;
  }
};

TEST(Pcss, PenumbraIsAsWideAsTheBlockersDepthSays) {
  // 2 r (V - B)/B, less what the narrow ends of the disc leave under 0.02.
  EXPECT_NEAR(Scene(5).penumbra(0.5f), 1.0f, 0.25f);
  EXPECT_NEAR(Scene(8).penumbra(0.5f), 0.25f, 0.1f);
}

TEST(Pcss, NoBlockerIsLit) {
  const Floats v = Scene(10).visibility(1);
  for (int x = 0; x < Scene::count; ++x) EXPECT_EQ(v(x, 0), 1.0f);
}

TEST(Pcss, RadiusZeroIsTheHardTest) {
  const Scene scene(5);
  PcfParams hard;
  hard.radius = 0;
  const Floats v = scene.visibility(0);
  const Floats pcf = pcfVisibility(scene.position, scene.normal, scene.labels, scene.map, hard);
  for (int x = 0; x < Scene::count; ++x) EXPECT_EQ(v(x, 0), pcf(x, 0));
}

TEST(Pcss, RefusesAnEmptyMap) {
  Scene scene(5);
  scene.map.depth = {};
  EXPECT_THROW(scene.visibility(1), InputError);
}

}  // namespace
}  // namespace kagefude
