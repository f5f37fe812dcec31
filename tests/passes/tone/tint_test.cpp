#include "passes/tone/tint.h"

#include <gtest/gtest.h>

#include <limits>

namespace kagefude {
namespace {

TEST(Tint, BrightnessIsKeptAndTheColourTurns) {
  TintParams params;
  params.light = 1;
  const V3f warm = V3f(1.4f, 0.95f, 0.3f) / luminanceOf({1.4f, 0.95f, 0.3f});
  const V3f grey(0.5f);
  const V3f lit = tinted(grey, warm, 1.0f, params);
  EXPECT_NEAR(luminanceOf(lit), 0.5f, 1e-6f);
  EXPECT_NEAR(lit.x / lit.z, 1.4f / 0.3f, 1e-4f);
  params.light = 0;
  EXPECT_EQ(tinted(grey, warm, 1.0f, params), grey);
}

TEST(Tint, TheShadowsColourGrowsWithTheDark) {
  TintParams params;
  params.shadow = {0.2f, 0.3f, 0.9f};
  params.shadowStrength = 1;
  const V3f grey(0.4f);
  EXPECT_EQ(tinted(grey, V3f(1.0f), 1.0f, params), grey);
  const V3f dark = tinted(grey, V3f(1.0f), 0.0f, params);
  EXPECT_NEAR(luminanceOf(dark), 0.4f, 1e-6f);
  EXPECT_NEAR(dark.z / dark.x, 4.5f, 1e-4f);
  const V3f half = tinted(grey, V3f(1.0f), 0.5f, params);
  EXPECT_GT(half.z, grey.z);
  EXPECT_LT(half.z, dark.z);
  EXPECT_EQ(tinted(grey, V3f(1.0f), std::numeric_limits<float>::quiet_NaN(), params), dark);
}

TEST(Tint, WhatTheLightSwallowsIsNotBlownUp) {
  TintParams params;
  params.light = 1;
  const V3f blue(0.0f, 0.0f, 0.5f), red = V3f(1, 0, 0) / 0.2126f;
  EXPECT_EQ(tinted(blue, red, 1.0f, params), blue);  // nothing would be left
  const V3f nearly = tinted({0.001f, 0.0f, 0.5f}, red, 1.0f, params);
  EXPECT_LE(nearly.x, 4 * 0.001f / 0.2126f + 1e-6f);
  params.shadow = {0, 0, 0};
  EXPECT_EQ(tinted({0.3f, 0.3f, 0.3f}, V3f(1.0f), 0.0f, params), V3f(0.3f));
}

}  // namespace
}  // namespace kagefude
