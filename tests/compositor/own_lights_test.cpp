// Lights with strips of their own, and what is bright without the lights.
#include "compositor/own_lights.h"

#include <cmath>

#include "compositor/map_frame.h"
#include "exr/write_image.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

using testing::MapFrame;

/// Two suns on level ground, of cosines 0.6 and 0.8; by their strengths one gives three quarters of
/// the light, the other one quarter. Strips are scene-linear and have one colour a row.
class LightsOfTheirOwn : public ::testing::Test {
 protected:
  LightsOfTheirOwn() {
    addSun("Key", V3f(0.8f, 0, -0.6f), 3);
    addSun("Rim", V3f(-0.6f, 0, -0.8f), 1);
    writeStrip("even.exr", {0.2f, 0.2f, 0.2f}, {1.0f, 0.8f, 0.6f});
    writeStrip("rim.exr", {0, 0, 0}, {0, 0.4f, 2});
  }
  void addSun(const std::string& name, const V3f& direction, double strength) {
    frame.addSun(name, direction);
    frame.sidecar["lights"].back()["energy"] = strength;
  }
  /// From `dark` in the lowest row to `bright` in the highest, evenly.
  void writeStrip(const std::string& name, const V3f& dark, const V3f& bright) const {
    constexpr int rows = 64;
    Floats r(4, rows), g(4, rows), b(4, rows);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < 4; ++x) {
        const V3f c = dark + (bright - dark) * (float(rows - 1 - y) / float(rows - 1));
        r(x, y) = c.x;
        g(x, y) = c.y;
        b(x, y) = c.z;
      }
    OutputImage image;
    image.dataWindow = image.displayWindow = {0, 0, 4, rows};
    image.channels = {floatChannel("R", PixelType::single, r),
                      floatChannel("G", PixelType::single, g),
                      floatChannel("B", PixelType::single, b)};
    writeExr(frame.folder / name, image);
  }
  V3f colourOf(const std::string& look) const {
    return testing::colourAt(frame.comp("brush.contrast = 0\n" + look), 3, 4);
  }
  static std::string style(const std::string& keys = "") {
    return "[[style]]\nobject = \"*\"\nstrip = \"even.exr\"\ncolour = \"replace\"\n" + keys;
  }
  static void expectNear(const V3f& got, const V3f& wanted) {
    // Rows lie half a texel within the strip.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], wanted[k], 0.02f) << "channel " << k;
  }
  static V3f even(float tone) { return V3f(0.2f) + (V3f(1.0f, 0.8f, 0.6f) - V3f(0.2f)) * tone; }

  MapFrame frame;
};

constexpr float keyPart = 0.75f * 0.6f, rimPart = 0.25f * 0.8f;

TEST_F(LightsOfTheirOwn, ALightAddsWhatItsStripHasBeyondItsDarkestRow) {
  expectNear(colourOf(style()), even(keyPart + rimPart));
  const V3f wanted = even(keyPart) + V3f(0, 0.4f, 2) * rimPart;
  expectNear(colourOf(style("light_strips = [\"Rim=rim.exr\"]\n")), wanted);
  expectNear(colourOf("[[light]]\nname = \"Rim\"\nstrip = \"rim.exr\"\n" + style()), wanted);
}

TEST_F(LightsOfTheirOwn, OneEvenStripForAllIsTheStyles) {
  const V3f together = colourOf(style());
  expectNear(colourOf(style("light_strips = [\"Rim=even.exr\"]\n")), together);
  expectNear(colourOf(style("light_strips = [\"*=even.exr\"]\n")), together);
}

TEST_F(LightsOfTheirOwn, WithoutALightLeftTheStylesDarkestRowIsTheAmbient) {
  const V3f rim = V3f(0, 0.4f, 2);
  expectNear(colourOf(style("light_strips = [\"*=rim.exr\"]\n")),
             even(0) + rim * keyPart + rim * rimPart);
}

TEST_F(LightsOfTheirOwn, AStyleTakesALightBackAndTheFirstThatFitsHolds) {
  const std::string light = "[[light]]\nname = \"Rim\"\nstrip = \"rim.exr\"\n";
  expectNear(colourOf(light + style("light_strips = [\"Rim=\"]\n")), colourOf(style()));
  expectNear(colourOf(style("light_strips = [\"R*=rim.exr\", \"Rim=even.exr\"]\n")),
             even(keyPart) + V3f(0, 0.4f, 2) * rimPart);
}

TEST_F(LightsOfTheirOwn, OnlyTheStylesThatSayItHaveIt) {
  frame.addOther();
  const std::string look =
      "brush.contrast = 0\n[[style]]\nobject = \"Other\"\nstrip = \"even.exr\"\ncolour = "
      "\"replace\"\nlight_strips = [\"Rim=rim.exr\"]\n" +
      style();
  const FrameResult result = frame.comp(look);
  expectNear(testing::colourAt(result, 1, 4), even(keyPart + rimPart));
  expectNear(testing::colourAt(result, 6, 4), even(keyPart) + V3f(0, 0.4f, 2) * rimPart);
}

TEST_F(LightsOfTheirOwn, IrradianceCountsByTheLightsPart) {
  expectNear(
      colourOf("tone.light = \"irradiance\"\n" + style("light_strips = [\"Rim=rim.exr\"]\n")),
      even(keyPart) + V3f(0, 0.4f, 2) * rimPart);
}

TEST_F(LightsOfTheirOwn, WrongEntriesAreRefused) {
  EXPECT_NE(frame.errorOf(style("light_strips = [\"rim.exr\"]\n"))
                .find("style.light_strips wants LIGHT=STRIP"),
            std::string::npos);
  EXPECT_NE(frame.errorOf(style("light_strips = [\"Rm=rim.exr\"]\n"))
                .find("gives Rm a strip, which is no light of the frame (did you mean Rim?)"),
            std::string::npos)
      << frame.errorOf(style("light_strips = [\"Rm=rim.exr\"]\n"));
  EXPECT_NE(frame.errorOf(style("light_strips = [\"Rim=rim.exr\", \"Rim=even.exr\"]\n"))
                .find("gives light Rim two strips"),
            std::string::npos);
  EXPECT_NE(frame.errorOf(style("light_strips = [\"Rim=none.exr\"]\n")).find("does not exist"),
            std::string::npos);
}

TEST_F(LightsOfTheirOwn, OneThatIsSwitchedOffAddsNothing) {
  const std::string look = "[[light]]\nname = \"Rim\"\non = false\nstrip = \"rim.exr\"\n";
  expectNear(colourOf(look + style()), even(0.6f));
}

TEST_F(LightsOfTheirOwn, TheWorldLiftsTheToneByItsPartOfAllLight) {
  frame.sidecar["world"] = {{"radiance", {1 / M_PI, 1 / M_PI, 1 / M_PI}}};
  // Irradiance 1 of the world beside 4 of the suns: a fifth.
  const float lit = keyPart + rimPart;
  EXPECT_NEAR(frame.tone("tone.world = 1\n")(3, 4), 0.2f + 0.8f * lit, 1e-5f);
  EXPECT_NEAR(frame.tone("tone.world = 0.5\n")(3, 4), 1.0f / 9 + 8.0f / 9 * lit, 1e-5f);
  EXPECT_NEAR(frame.tone("scene.world = [0, 0, 0]\ntone.world = 1\n")(3, 4), lit, 1e-5f);
  EXPECT_NEAR(frame.tone("")(3, 4), lit, 1e-6f);
  frame.sidecar.erase("world");
  const FrameResult unknown = frame.comp("tone.world = 1\n");
  ASSERT_EQ(unknown.warnings.size(), 1u);
  EXPECT_NE(unknown.warnings[0].find("scene.world"), std::string::npos);
}

TEST_F(LightsOfTheirOwn, WhatSurfacesGiveOffLiftsTheirTone) {
  for (const char* channel : {"Emit.R", "Emit.G", "Emit.B"}) {
    frame.plane(channel)(3, 4) = 0.2f;
    frame.plane(channel)(4, 4) = 9;
  }
  frame.plane("Emit.G")(5, 4) = std::nanf("");
  const Floats tone = frame.tone("tone.emission = 1\n");
  const float lit = keyPart + rimPart;
  EXPECT_NEAR(tone(2, 4), lit, 1e-6f);
  EXPECT_NEAR(tone(3, 4), lit + 0.2f * pi / 4, 1e-5f) << "white shines as 4 / pi under the suns";
  EXPECT_EQ(tone(4, 4), 1.0f);
  EXPECT_NEAR(tone(5, 4), lit, 1e-6f);
}

TEST_F(LightsOfTheirOwn, EmissionThatThereIsNotLiftsNothingAndIsSaid) {
  const FrameResult without = frame.comp("tone.emission = 1\n");
  ASSERT_EQ(without.warnings.size(), 1u);
  EXPECT_NE(without.warnings[0].find("no Emission pass"), std::string::npos);
  EXPECT_NEAR(frame.tone("tone.emission = 1\n")(3, 4), keyPart + rimPart, 1e-6f);
  // A pass that is named and is not there is a slip.
  EXPECT_NE(frame.errorOf("tone.emission = 1\nframe.emission = \"Glow\"\n").find("Glow"),
            std::string::npos);
}

}  // namespace
}  // namespace kagefude
