#include "passes/tone/tone_floor.h"

#include <gtest/gtest.h>

#include <limits>

namespace kagefude {
namespace {

TEST(ToneFloor, ByHand) {
  ToneParams world, glow, both;
  world.world = 0.5f;
  glow.emission = 2;
  both.world = 0.5f;
  both.emission = 2;
  const ToneParams params[] = {world, glow, both};
  Floats tone(5, 1, 0.4f);
  Floats emission(5, 1, 0.5f);
  Plane<uint16_t> index(5, 1);
  for (int x = 0; x < 5; ++x) index(x, 0) = static_cast<uint16_t>(x);
  raiseTone(tone, index, params, {2.0f, emission, 0.25f});
  EXPECT_EQ(tone(0, 0), 0.4f) << "background";
  EXPECT_FLOAT_EQ(tone(1, 0), 0.5f + 0.5f * 0.4f);
  EXPECT_FLOAT_EQ(tone(2, 0), 0.4f + 2 * 0.25f * 0.5f);
  EXPECT_FLOAT_EQ(tone(3, 0), 0.5f + 0.5f * (0.4f + 0.25f));
  EXPECT_EQ(tone(4, 0), 0.4f) << "beyond the list";
}

TEST(ToneFloor, StaysWithinItsBounds) {
  ToneParams params;
  params.emission = 1;
  Floats tone(4, 1, 0.5f), emission(4, 1);
  emission(0, 0) = 100;
  emission(1, 0) = -1;
  emission(2, 0) = std::numeric_limits<float>::quiet_NaN();
  tone(3, 0) = std::numeric_limits<float>::quiet_NaN();
  const Plane<uint16_t> index(4, 1, uint16_t{1});
  raiseTone(tone, index, {&params, 1}, {0, emission, 1.0f});
  EXPECT_EQ(tone(0, 0), 1.0f);
  EXPECT_EQ(tone(1, 0), 0.5f);
  EXPECT_EQ(tone(2, 0), 0.5f);
  EXPECT_EQ(tone(3, 0), 0.0f);
}

TEST(ToneFloor, NothingWithoutItsKeys) {
  const ToneParams params;
  Floats tone(1, 1, 0.3f), emission(1, 1, 5.0f);
  const Plane<uint16_t> index(1, 1, uint16_t{1});
  raiseTone(tone, index, {&params, 1}, {3.0f, emission, 1.0f});
  EXPECT_EQ(tone(0, 0), 0.3f);
  EXPECT_EQ(worldShare(params, 3.0f), 0.0f);
}

}  // namespace
}  // namespace kagefude
