#include "passes/depth_map/map_agreement.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "passes/depth_map/half_floor.h"

namespace kagefude {
namespace {

struct AgreeingFloor : HalfFloor {
  AgreeingFloor() { light.position = V3f(0, 0, lightHeight); }

  MapAgreement with(const Bytes& mask) const {
    const View<const uint8_t> masks[] = {mask, mask};
    return agreementOf(masks, light, position, normal, labels, map);
  }

  Light light;
};

TEST(MapAgreement, TheLightsOwnMapAgrees) {
  AgreeingFloor floor;
  floor.blockLeft();
  const MapAgreement found = floor.with(floor.maskTo(0));
  EXPECT_EQ(found.hidden, 100u);
  EXPECT_EQ(found.hiddenInMap, 100u);
  EXPECT_EQ(found.lit, 100u);
  EXPECT_EQ(found.litInMap, 100u);
  EXPECT_FALSE(found.contradicts());
}

TEST(MapAgreement, AMapThatHidesNothingOrTheOtherHalfContradicts) {
  AgreeingFloor floor;
  const MapAgreement nothing = floor.with(floor.maskTo(0));
  EXPECT_EQ(nothing.hiddenInMap, 0u);
  EXPECT_EQ(nothing.litInMap, 100u);
  EXPECT_TRUE(nothing.contradicts());
  floor.block(5, [](int x, int) { return x >= 128; });
  const MapAgreement other = floor.with(floor.maskTo(0));
  EXPECT_EQ(other.hiddenInMap, 0u);
  EXPECT_EQ(other.litInMap, 0u);
  EXPECT_TRUE(other.contradicts());
}

TEST(MapAgreement, MatricesThatSendPlacesNowhereContradict) {
  AgreeingFloor floor;
  floor.blockLeft();
  for (auto& row : floor.map.lightFromWorld.m)
    for (double& entry : row) entry = 0;
  EXPECT_TRUE(floor.with(floor.maskTo(0)).contradicts());
}

TEST(MapAgreement, WhereMasksDisagreeOrTheLightGrazesNothingCounts) {
  AgreeingFloor floor;
  const Bytes dark = floor.maskTo(100), bright = floor.maskTo(-100);
  const View<const uint8_t> masks[] = {dark, bright};
  const MapAgreement found =
      agreementOf(masks, floor.light, floor.position, floor.normal, floor.labels, floor.map);
  EXPECT_EQ(found.hidden + found.lit, 0u);
  EXPECT_FALSE(found.contradicts());
  floor.light.position = V3f(500, 0, 10);
  EXPECT_EQ(floor.with(dark).hidden, 0u);
}

TEST(MapAgreement, EitherKindContradictsByItself) {
  AgreeingFloor floor;
  EXPECT_TRUE(floor.with(floor.maskTo(100)).contradicts());    // no place is lit
  EXPECT_FALSE(floor.with(floor.maskTo(-100)).contradicts());  // nor hidden
  floor.blockLeft();
  EXPECT_TRUE(floor.with(floor.maskTo(-100)).contradicts());
}

TEST(MapAgreement, AnEmptyMapContradictsWhereAnythingIsHiddenInPart) {
  AgreeingFloor floor;
  floor.depth.fill(1e10f);
  const Bytes dark = floor.maskTo(100), bright = floor.maskTo(-100);
  const View<const uint8_t> masks[] = {bright, dark};
  const MapAgreement found =
      agreementOf(masks, floor.light, floor.position, floor.normal, floor.labels, floor.map);
  EXPECT_EQ(found.partly, 200u);
  EXPECT_TRUE(found.mapEmpty);
  EXPECT_TRUE(found.contradicts());
  EXPECT_FALSE(floor.with(bright).contradicts()) << "where nothing casts";
}

TEST(MapAgreement, AMapThatSeesPastLitPlacesContradictsUnlessItHidesWhatMasksHide) {
  AgreeingFloor floor;
  floor.depth.fill(1e10f);
  floor.blockLeft();
  const MapAgreement fits = floor.with(floor.maskTo(0));
  EXPECT_EQ(fits.litInside, 100u);
  EXPECT_EQ(fits.litOwn, 0u);
  EXPECT_FALSE(fits.contradicts()) << "the floor casts no shadow";
  floor.depth.fill(1e10f);
  floor.block(5, [](int, int y) { return y < 9; });
  EXPECT_TRUE(floor.with(floor.maskTo(-100)).contradicts());
}

TEST(MapAgreement, OfAFewPixelsNothingIsKnown) {
  AgreeingFloor floor;
  EXPECT_FALSE(floor.with(floor.maskTo(-1.5f)).contradicts());  // 62 pixels are dark
  EXPECT_TRUE(floor.with(floor.maskTo(-1.4f)).contradicts());   // 65
}

TEST(MapAgreement, SizesAndAnEmptyMapAreRefused) {
  AgreeingFloor floor;
  EXPECT_THROW(floor.with(Bytes(3, 3, uint8_t{0})), InputError);
  floor.map.depth = {};
  EXPECT_THROW(floor.with(floor.maskTo(0)), InputError);
}

}  // namespace
}  // namespace kagefude
