#include "sequence/shot_breaks.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

Sidecar frameOf(double subjectRadius, double offset = 0.3) {
  SidecarLight light;
  light.name = "Key";
  light.radius = 0.3;
  light.subjectRadius = subjectRadius;
  light.masks = LightMasks{MaskArrangement::disc, offset, 0, {}};
  Sidecar sidecar;
  sidecar.lights = {light};
  return sidecar;
}

std::vector<ShotBreak> breaksOf(const std::vector<Sidecar>& frames) {
  std::vector<ShotBreak> breaks;
  for (size_t i = 1; i < frames.size(); ++i)
    noteShotBreaks(frames[i - 1], frames[i], static_cast<int>(i) + 1, breaks);
  return breaks;
}

TEST(ShotBreaks, NamesTheFrameInWhichTheSubjectGrows) {
  const auto breaks = breaksOf({frameOf(1.21), frameOf(1.21), frameOf(4.64), frameOf(4.64)});
  ASSERT_EQ(breaks.size(), 1u);
  EXPECT_EQ(breaks[0].frames, std::vector<int>{3});
  EXPECT_EQ(breaks[0].sentence(),
            "frame 3: the radius of what light Key lights goes from 1.21 to 4.64, so strokes of "
            "grounds change their size; export the shot again, so that its JSONs say it for the "
            "whole shot, or give [scene] in the look");
}

TEST(ShotBreaks, AreOneLineAKind) {
  const auto breaks = breaksOf({frameOf(1), frameOf(2), frameOf(1), frameOf(2)});
  ASSERT_EQ(breaks.size(), 1u);
  EXPECT_EQ(breaks[0].sentence().substr(0, 22), "frame 2 (and 2 more): ");
}

TEST(ShotBreaks, OffsetsMayChangeOnlyWithTheLight) {
  EXPECT_EQ(breaksOf({frameOf(1, 0.3), frameOf(1, 0.4)}).size(), 1u);
  Sidecar larger = frameOf(1, 0.4);
  larger.lights[0].radius = 0.4;
  EXPECT_TRUE(breaksOf({frameOf(1, 0.3), larger}).empty());
}

TEST(ShotBreaks, RoundingAndLightsThatComeAreNone) {
  Sidecar more = frameOf(1.0000001);
  more.lights.push_back(more.lights[0]);
  more.lights[1].name = "Rim";
  EXPECT_TRUE(breaksOf({frameOf(1), more}).empty());
  EXPECT_TRUE(breaksOf({frameOf(0), frameOf(0)}).empty());
}

TEST(ShotBreaks, FramesOfTwoExportsAreNamed) {
  Sidecar early = frameOf(1), late = frameOf(1);
  early.shot = WholeShot{1, 24, {0, 0, 0}, 1, 5, {{"Key", 2, 2, {}, {}}}};
  late.shot = early.shot;
  EXPECT_TRUE(breaksOf({early, late}).empty());
  late.shot->lights[0].irradiance = 3;
  EXPECT_EQ(breaksOf({early, late}).size(), 1u);
  EXPECT_EQ(breaksOf({early, frameOf(1)}).size(), 1u);
}

}  // namespace
}  // namespace kagefude
