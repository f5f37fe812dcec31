// From shade and shadow to the tone that strokes follow, and which style paints what.
#include <cmath>

#include <algorithm>

#include "compositor/map_frame.h"

namespace kagefude {
namespace {

using testing::colourAt;
using testing::MapFrame;
using testing::TestFrame;

/// A sun whose cosine is 0.6 everywhere.
class ToneAndStyle : public ::testing::Test {
 protected:
  ToneAndStyle() { frame.addSun("Sun", V3f(0.8f, 0, -0.6f)); }
  float toneOf(const std::string& look, int x = 6) { return frame.tone(look)(x, 4); }
  MapFrame frame;
};

TEST_F(ToneAndStyle, LevelsAndGammaByHand) {
  EXPECT_NEAR(toneOf(""), 0.6f, 1e-6f);
  EXPECT_NEAR(toneOf("tone.black = 0.2\n"), 0.5f, 1e-6f);
  EXPECT_NEAR(toneOf("tone.white = 0.8\n"), 0.75f, 1e-6f);
  EXPECT_NEAR(toneOf("tone.black = 0.35\ntone.gamma = 2\n"), std::sqrt(0.25f / 0.65f), 1e-6f);
  EXPECT_EQ(toneOf("tone.white = 0.5\n"), 1.0f);
  EXPECT_EQ(toneOf("tone.black = 0.7\n"), 0.0f);
}

TEST_F(ToneAndStyle, WrapByHand) {
  EXPECT_NEAR(toneOf("shade.wrap = 0.5\n"), (0.6f + 0.5f) / 1.5f, 1e-6f);
}

TEST_F(ToneAndStyle, ShadowAndShadeMergeByHand) {
  // Half of the sun's light is taken from the left half.
  frame.addLid();
  frame.sidecar["lights"][0]["direction"] = {0.0, 0.8, -0.6};
  const std::string half = "[shadow]\nmethod = \"coverage\"\nstrength = 0.5\n";
  EXPECT_NEAR(toneOf(half, 1), 0.1f, 1e-6f) << "0.5 + 0.6 - 1";
  EXPECT_NEAR(toneOf(half + "[merge]\nmode = \"product\"\n", 1), 0.3f, 1e-6f);
  EXPECT_NEAR(toneOf(half + "[merge]\nmode = \"minimum\"\n", 1), 0.5f, 1e-6f);
  EXPECT_NEAR(toneOf(half), 0.6f, 1e-6f) << "beside the lid";
}

TEST_F(ToneAndStyle, AStylesToneIsItsOwn) {
  frame.addOther();
  const std::string look = "tone.black = 0.2\n[[style]]\nobject = \"Other\"\ntone.black = 0.35\n";
  EXPECT_NEAR(toneOf(look, 1), 0.5f, 1e-6f) << "the look's";
  EXPECT_NEAR(toneOf(look, 6), 0.25f / 0.65f, 1e-6f) << "the style's";
}

TEST_F(ToneAndStyle, TheBackgroundHasNoTone) {
  frame.clearUpperHalf();
  EXPECT_EQ(frame.tone("")(2, 1), 0.0f);
}

/// Which style holds on each object shows by the black point that it gives the tone.
class StyleChoice : public ToneAndStyle {
 protected:
  StyleChoice() { frame.addOther(); }
  static std::string style(const std::string& keys, float black) {
    return "[[style]]\n" + keys + "\ntone.black = " + std::to_string(black) + "\n";
  }
  /// Thing's black point, and Other's.
  void expectBlack(const std::string& styles, float thing, float other) {
    const Floats tone = frame.tone(styles);
    EXPECT_NEAR(tone(1, 4), (0.6f - thing) / (1 - thing), 1e-5f) << styles;
    EXPECT_NEAR(tone(6, 4), (0.6f - other) / (1 - other), 1e-5f) << styles;
  }
};

TEST_F(StyleChoice, ByObject) {
  expectBlack(style("object = \"Thing\"", 0.2f) + style("object = \"O*\"", 0.4f), 0.2f, 0.4f);
}

TEST_F(StyleChoice, ByIndex) {
  expectBlack(style("index = 2", 0.4f) + style("index = 1", 0.2f), 0.2f, 0.4f);
}

TEST_F(StyleChoice, ByMaterial) {
  frame.sidecar["materials"] = {{{"name", "Clay"}, {"index", 1}},
                                {{"name", "Glass"}, {"index", 2}}};
  for (int y = 0; y < MapFrame::side; ++y)
    for (int x = 0; x < MapFrame::side; ++x)
      frame.plane("IndexMA.X")(x, y) = x < MapFrame::side / 2 ? 1.0f : 2.0f;
  expectBlack(style("material = \"Glass\"", 0.4f) + style("material = \"Cl*\"", 0.2f), 0.2f, 0.4f);
}

TEST_F(StyleChoice, TheFirstOfEqualsAndTheHighestPriority) {
  const std::string first = style("object = \"*\"", 0.2f);
  expectBlack(first + style("object = \"*\"", 0.4f), 0.2f, 0.2f);
  expectBlack(first + style("object = \"*\"\npriority = 1", 0.4f), 0.4f, 0.4f);
}

TEST_F(StyleChoice, AnUnknownLightOfAStyleIsNamed) {
  const std::string error = frame.errorOf("[[style]]\nobject = \"*\"\nlight = \"Snu\"\n");
  EXPECT_NE(error.find("Snu"), std::string::npos) << error;
  EXPECT_NE(error.find("did you mean Sun?"), std::string::npos) << error;
}

TEST_F(StyleChoice, MultiplyTakesTheAlbedoAndReplaceDoesNot) {
  frame.plane("DiffCol.R", 0.5f);
  frame.plane("DiffCol.G", 0.25f);
  frame.plane("DiffCol.B", 0.0f);
  const std::string look = "[[style]]\nobject = \"*\"\nstrip = \"builtin:soft\"\ncolour = ";
  const V3f alone = colourAt(frame.comp(look + "\"replace\"\n"), 2, 4);
  const V3f tinted = colourAt(frame.comp(look + "\"multiply\"\n"), 2, 4);
  EXPECT_GT(alone.z, 0.0f);
  EXPECT_EQ(tinted, V3f(alone.x * 0.5f, alone.y * 0.25f, 0.0f));
}

TEST_F(ToneAndStyle, ASurfaceWithoutDiffuseColourIsNamedWhereTheStripMultiplies) {
  const auto said = [&](const std::string& colour) {
    const FrameResult result = frame.comp(
        "[[style]]\nobject = \"*\"\nstrip = \"builtin:soft\"\ncolour = \"" + colour + "\"\n");
    return std::count_if(result.warnings.begin(), result.warnings.end(), [](const auto& warning) {
      return warning.find("no diffuse colour") != std::string::npos &&
             warning.find("(Thing)") != std::string::npos;
    });
  };
  EXPECT_EQ(said("multiply"), 0) << "no pass of it";
  for (const char* name : {"DiffCol.R", "DiffCol.G", "DiffCol.B"}) frame.plane(name, 0.0f);
  EXPECT_EQ(said("multiply"), 1);
  EXPECT_EQ(said("replace"), 0);
  frame.plane("DiffCol.G")(1, 2) = 0.25f;
  EXPECT_EQ(said("multiply"), 0) << "a pixel has some";
}

TEST_F(StyleChoice, StripsOfPictureFilesAreReadBesideTheLook) {
  Floats green(32, 32, 0.75f), none(32, 32, 0.0f);
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, 32, 32};
  image.channels = {floatChannel("R", PixelType::single, none),
                    floatChannel("G", PixelType::single, green),
                    floatChannel("B", PixelType::single, none)};
  writeExr(frame.folder / "green.exr", image);
  const V3f colour =
      colourAt(frame.comp("[[style]]\nobject = \"Thing\"\nstrip = \"green.exr\"\n"), 2, 4);
  EXPECT_EQ(colour.x, 0.0f);
  EXPECT_GT(colour.y, 0.0f);
  EXPECT_EQ(colour.z, 0.0f);
}

TEST_F(StyleChoice, ABrushOfItsOwnChangesOnlyItsObject) {
  const FrameResult plain = frame.comp("");
  const FrameResult own = frame.comp("[[style]]\nobject = \"Other\"\nbrush.contrast = 0\n");
  EXPECT_EQ(colourAt(plain, 1, 4), colourAt(own, 1, 4));
  int changed = 0;
  for (int y = 0; y < MapFrame::side; ++y)
    for (int x = 5; x < MapFrame::side; ++x)
      changed += colourAt(plain, x, y) != colourAt(own, x, y);
  EXPECT_GT(changed, 0);
}

}  // namespace
}  // namespace kagefude
