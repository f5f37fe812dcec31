#include "passes/depth_map/pcss.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "passes/depth_map/map_floor.h"
#include "passes/depth_map/pcf.h"

namespace kagefude {
namespace {

/// A floor with a blocker at depth `blocker` over x < 0.
struct Scene : MapFloor {
  static constexpr int count = 400;

  explicit Scene(float blocker) : MapFloor(count) {
    block(blocker, [](int x, int) { return x < 128; });
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
