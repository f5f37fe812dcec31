#include "passes/tone/merge.h"

#include <gtest/gtest.h>

#include <limits>

#include "passes/tone/tone.h"

namespace kagefude {
namespace {

float merged(float a, float b, MergeParams::Mode mode) {
  Floats pa(1, 1, a), pb(1, 1, b), out(1, 1);
  MergeParams params;
  params.mode = mode;
  mergeTone(pa, pb, params, out);
  return out(0, 0);
}

TEST(Merge, ModesByHand) {
  EXPECT_FLOAT_EQ(merged(0.75f, 0.5f, MergeParams::Mode::subtract), 0.25f);
  EXPECT_EQ(merged(0.25f, 0.5f, MergeParams::Mode::subtract), 0.0f);
  EXPECT_FLOAT_EQ(merged(0.75f, 0.5f, MergeParams::Mode::product), 0.375f);
  EXPECT_FLOAT_EQ(merged(0.75f, 0.5f, MergeParams::Mode::minimum), 0.5f);
}

TEST(Merge, NotANumberIsBlack) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (auto mode :
       {MergeParams::Mode::subtract, MergeParams::Mode::product, MergeParams::Mode::minimum}) {
    EXPECT_EQ(merged(nan, 1, mode), 0.0f);
    EXPECT_EQ(merged(1, nan, mode), 0.0f);
  }
}

float combined(float a, float b, float weightOfB, MergeParams::Lights lights) {
  Floats pa(1, 1, a), pb(1, 1, b), out(1, 1);
  MergeParams params;
  params.lights = lights;
  const View<const float> tones[] = {pa.view(), pb.view()};
  const float weights[] = {1.0f, weightOfB};
  combineTones(tones, weights, params, out);
  return out(0, 0);
}

TEST(Merge, LightsByHand) {
  EXPECT_FLOAT_EQ(combined(0.5f, 0.5f, 0.5f, MergeParams::Lights::sum), 0.75f);
  EXPECT_EQ(combined(0.75f, 0.75f, 1, MergeParams::Lights::sum), 1.0f);
  EXPECT_FLOAT_EQ(combined(0.5f, 0.75f, 1, MergeParams::Lights::maximum), 0.75f);
  EXPECT_FLOAT_EQ(combined(0.5f, 0.5f, 1, MergeParams::Lights::screen), 0.75f);
}

TEST(Tone, LevelsAndGammaByHand) {
  ToneParams params;
  params.black = 0.2f;
  params.white = 0.6f;
  EXPECT_FLOAT_EQ(adjustTone(0.4f, params), 0.5f);
  EXPECT_EQ(adjustTone(0.1f, params), 0.0f);
  EXPECT_EQ(adjustTone(0.9f, params), 1.0f);
  params.gamma = 2;
  EXPECT_NEAR(adjustTone(0.3f, params), 0.5f, 1e-6f) << "square root of a quarter";
}

TEST(Tone, EqualLevelsMakeAStep) {
  ToneParams params;
  params.black = params.white = 0.5f;
  EXPECT_EQ(adjustTone(0.49f, params), 0.0f);
  EXPECT_EQ(adjustTone(0.5f, params), 1.0f);
  EXPECT_EQ(adjustTone(std::numeric_limits<float>::quiet_NaN(), params), 0.0f);
}

TEST(Tone, EveryStyleItsOwn) {
  Floats tone(3, 1, 0.5f);
  Plane<uint16_t> index(3, 1, uint16_t{0});
  index(1, 0) = 1;
  index(2, 0) = 9;
  ToneParams dark;
  dark.black = 0.5f;
  adjustTone(tone, index, std::span(&dark, 1));
  EXPECT_EQ(tone(0, 0), 0.5f);
  EXPECT_EQ(tone(1, 0), 0.0f);
  EXPECT_EQ(tone(2, 0), 0.5f);
}

}  // namespace
}  // namespace kagefude
