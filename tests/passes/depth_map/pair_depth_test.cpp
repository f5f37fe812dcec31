#include "passes/depth_map/pair_depth.h"

#include <gtest/gtest.h>

#include "passes/depth_map/hold_to_map.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

constexpr int count = 200;
constexpr float radius = 0.5f;

/// A floor under a light at (0, 0, 10), and masks in which whatever has x < edge is dark.
struct Scene {
  Floats depth{256, 256, 10.0f};
  Vec3Plane position{count, 1}, normal{count, 1};
  Labels labels{count, 1, 1u};
  ShadowMap map;

  Scene() {
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
  void blockLeft() {
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 128; ++x) depth(x, y) = 5;
  }
  float x(int i) const { return position.view()(i, 0).x; }
  Bytes maskTo(float edge) const {
    Bytes mask(count, 1, uint8_t{0});
    for (int i = 0; i < count; ++i) mask(i, 0) = x(i) > edge;
    return mask;
  }
  Floats pair(const Bytes& farMask, const Bytes& nearMask) const {
    const MaskPair masks{farMask, nearMask, {V3f(0, 0, 10), V3f(0, 0, 0.2f), radius}};
    return pairDepthVisibility(masks, position, normal, labels, labels, map, {});
  }
};

TEST(PairDepth, WhereMasksBearItOutTheMapGivesTheWidth) {
  Scene scene;
  scene.blockLeft();
  const Bytes mask = scene.maskTo(0);
  const Floats v = scene.pair(mask, mask);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(v(i, 0), discShare(scene.x(i) / radius), 0.03f) << i;
}

TEST(PairDepth, WhatTheMapLosesTheMasksHold) {
  const Scene scene;  // the map shows no blocker: it touches the floor
  const Bytes mask = scene.maskTo(1);
  const Floats v = scene.pair(mask, mask);
  for (int i = 0; i < count; ++i) EXPECT_EQ(v(i, 0), scene.x(i) > 1 ? 1.0f : 0.0f) << i;
}

TEST(PairDepth, WhatOnlyOneMaskContradictsIsTheMean) {
  const Scene scene;
  const Bytes lit = scene.maskTo(-100), dark = scene.maskTo(100);
  // No site of either kind: the search gives 1/2, the map 1.
  const Floats v = scene.pair(lit, dark);
  for (int i = 0; i < count; ++i) EXPECT_EQ(v(i, 0), 0.75f) << i;
}

struct Held {
  Scene scene;
  std::vector<Bytes> masks;
  LightShapeResult shape{Floats(count, 1, 0.25f), Floats(count, 1, 0.5f),
                         Bytes(count, 1, uint8_t{0})};

  void hold(int contradicting) {
    for (int k = 0; k < 9; ++k)
      masks.push_back(k < contradicting ? scene.maskTo(100) : scene.maskTo(-100));
    std::vector<PlacedMask> placed;
    for (const Bytes& mask : masks) placed.push_back({mask, V3f(0.05f, 0, 0)});
    holdToMap(placed, scene.position, scene.normal, scene.labels, scene.map, radius, shape);
  }
};

TEST(HoldToMap, TakesTheMapAroundUnsurePixelsOnly) {
  Held held;
  held.shape.unsure(100, 0) = 1;
  held.hold(0);
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(held.shape.visibility(i, 0), std::abs(i - 100) <= 4 ? 1.0f : 0.25f) << i;
    EXPECT_EQ(held.shape.confidence(i, 0), std::abs(i - 100) <= 4 ? 1.0f : 0.5f) << i;
  }
}

TEST(HoldToMap, MasksThatContradictTakeItsWeight) {
  Held one, three;
  one.shape.unsure(100, 0) = three.shape.unsure(100, 0) = 1;
  one.hold(1);
  three.hold(3);
  EXPECT_NEAR(one.shape.visibility(100, 0), 0.25f + 0.75f * (1 - 3.0f / 9), 1e-6f);
  EXPECT_NEAR(three.shape.visibility(100, 0), 0.25f, 1e-6f);
}

}  // namespace
}  // namespace kagefude
