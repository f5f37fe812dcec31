#include "passes/depth_map/hold_to_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "passes/depth_map/half_floor.h"

namespace kagefude {
namespace {

struct Held {
  static constexpr int count = HalfFloor::count;

  HalfFloor scene;
  std::vector<Bytes> masks;
  LightShapeResult shape{Floats(count, 1, 0.25f), Floats(count, 1, 0.5f),
                         Bytes(count, 1, uint8_t{0})};

  /// Holds to nine masks of an open floor, the first of which see nothing.
  void holdWithBlind(int blind) {
    for (int k = 0; k < 9; ++k) masks.push_back(scene.maskTo(k < blind ? 100.0f : -100.0f));
    hold();
  }
  void hold() {
    std::vector<PlacedMask> placed;
    for (const Bytes& mask : masks) placed.push_back({mask, V3f(0.05f, 0, 0)});
    holdToMap(placed, scene.position, scene.normal, scene.labels, scene.map, HalfFloor::radius,
              shape);
  }
};

TEST(HoldToMap, TakesTheMapAroundUnsurePixelsOnly) {
  Held held;
  held.shape.unsure(100, 0) = 1;
  held.holdWithBlind(0);
  for (int i = 0; i < Held::count; ++i) {
    EXPECT_EQ(held.shape.visibility(i, 0), std::abs(i - 100) <= 4 ? 1.0f : 0.25f) << i;
    EXPECT_EQ(held.shape.confidence(i, 0), std::abs(i - 100) <= 4 ? 1.0f : 0.5f) << i;
  }
}

TEST(HoldToMap, MasksThatContradictTakeItsWeight) {
  Held one, three;
  one.shape.unsure(100, 0) = three.shape.unsure(100, 0) = 1;
  one.holdWithBlind(1);
  three.holdWithBlind(3);
  EXPECT_NEAR(one.shape.visibility(100, 0), 0.25f + 0.75f * (1 - 3.0f / 9), 1e-6f);
  EXPECT_NEAR(three.shape.visibility(100, 0), 0.25f, 1e-6f);
}

TEST(HoldToMap, WhereBothSayAboutTheSameTheyAreAMeanByTheSquaresOfTheMasks) {
  // The open floor's map says 1; of nine masks the map counts 400 to 81.
  for (const float said : {0.95f, 0.85f}) {
    Held held;
    held.shape.visibility = Floats(Held::count, 1, said);
    held.shape.unsure(100, 0) = 1;
    held.holdWithBlind(0);
    const float byMasks = 81.0f / 481 * (1 - (1 - said) / 0.25f);
    EXPECT_NEAR(held.shape.visibility(100, 0), 1 - (1 - said) * byMasks, 1e-6f);
  }
}

TEST(HoldToMap, WhereTheLightGrazesMasksCountWhateverTheMapSays) {
  const auto grazed = [](float cosine) {
    Held held;
    held.shape.unsure(100, 0) = 1;
    // Seen from the middle of the floor the light is straight above: the normal's z is the cosine.
    held.scene.normal.set(100, 0, V3f(std::sqrt(1 - cosine * cosine), 0, cosine));
    held.holdWithBlind(0);
    return held.shape.visibility(100, 0);
  };
  EXPECT_NEAR(grazed(0.3f), 0.25f + 0.75f * (1 - 81.0f / 106), 6e-3f);
  EXPECT_NEAR(grazed(0.55f), 0.25f + 0.75f * (1 - 40.5f / 106), 6e-3f);
  EXPECT_EQ(grazed(0.9f), 1.0f);
}

TEST(HoldToMap, AMaskThatContradictsAtOnePixelLeavesNoMark) {
  Held held;
  held.shape.unsure(100, 0) = 1;
  for (int k = 0; k < 9; ++k) held.masks.push_back(held.scene.maskTo(-100));
  held.masks[4](100, 0) = 0;
  held.hold();
  EXPECT_GT(held.shape.visibility(100, 0), 0.25f + 0.75f * 0.9f);
}

TEST(HoldToMap, WhatNoMaskSeesStaysDark) {
  Held held;
  held.scene.blockLeft();
  held.shape.visibility = Floats(Held::count, 1, 0.0f);
  held.shape.unsure(100, 0) = 1;
  for (int k = 0; k < 9; ++k) held.masks.push_back(held.scene.maskTo(0));
  held.hold();
  for (int i = 96; i < 100; ++i) EXPECT_LE(held.shape.visibility(i, 0), 0.08f) << i;
}

}  // namespace
}  // namespace kagefude
