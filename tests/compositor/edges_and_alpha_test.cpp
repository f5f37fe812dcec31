// What stands where nothing is painted, how strokes end there, and the picture's alpha.
#include <algorithm>
#include <bit>

#include "compositor/map_frame.h"

namespace kagefude {
namespace {

using testing::colourAt;
using testing::MapFrame;

class EdgesAndAlpha : public ::testing::Test {
 protected:
  EdgesAndAlpha() {
    frame.addSun("Sun", {0, 0, -1});
    frame.clearUpperHalf();
  }
  /// A Cryptomatte in which Thing covers `share` of row 4, and else what the index pass says.
  void addCryptomatte(float share) {
    frame.sidecar["objects"][0]["crypto"] = "3f800001";
    const float id = std::bit_cast<float>(0x3f800001);
    Floats& ids = frame.plane("CryptoObject00.r");
    Floats& shares = frame.plane("CryptoObject00.g");
    frame.plane("CryptoObject00.b");
    frame.plane("CryptoObject00.a");
    for (int y = 4; y < MapFrame::side; ++y)
      for (int x = 0; x < MapFrame::side; ++x) {
        ids(x, y) = id;
        shares(x, y) = y == 4 ? share : 1.0f;
      }
  }
  MapFrame frame;
};

constexpr const char* transparent = "output.background = \"transparent\"\n";

TEST_F(EdgesAndAlpha, WithoutBeautyTheBackgroundIsEmpty) {
  const FrameResult result = frame.comp("");
  EXPECT_EQ(colourAt(result, 2, 1), V3f(0, 0, 0));
  EXPECT_EQ(result.alpha(2, 1), 0.0f);
  EXPECT_EQ(result.alpha(2, 6), 1.0f);
  EXPECT_GT(colourAt(result, 2, 6).x, 0.0f);
}

TEST_F(EdgesAndAlpha, BeautyStandsBehindTheStrokes) {
  frame.addBeauty({0.1f, 0.2f, 0.3f}, 0.25f);
  const FrameResult result = frame.comp("");
  EXPECT_EQ(colourAt(result, 2, 1), V3f(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(result.alpha(2, 1), 0.25f) << "alpha is associated and goes along";
  EXPECT_EQ(result.alpha(2, 6), 1.0f) << "paint is opaque";
  EXPECT_NE(colourAt(result, 2, 6), V3f(0.1f, 0.2f, 0.3f));
}

TEST_F(EdgesAndAlpha, BeautyWithoutAlphaIsOpaque) {
  frame.plane("Combined.R", 0.5f);
  frame.plane("Combined.G", 0.5f);
  frame.plane("Combined.B", 0.5f);
  EXPECT_EQ(frame.comp("").alpha(2, 1), 1.0f);
}

TEST_F(EdgesAndAlpha, TransparentLeavesTheBeautyOut) {
  frame.addBeauty({0.1f, 0.2f, 0.3f}, 1.0f);
  const FrameResult result = frame.comp(transparent);
  EXPECT_EQ(colourAt(result, 2, 1), V3f(0, 0, 0));
  EXPECT_EQ(result.alpha(2, 1), 0.0f);
}

TEST_F(EdgesAndAlpha, AThingThatCoversPixelsButStandsAtNoneIsNamed) {
  const auto said = [&] {
    const FrameResult result = frame.comp("");
    return std::count_if(result.warnings.begin(), result.warnings.end(), [](const auto& warning) {
      return warning.find("stand at no pixel's centre") != std::string::npos &&
             warning.find("(Veil)") != std::string::npos;
    });
  };
  addCryptomatte(1.0f);
  frame.addObject("Veil", 2, {-1, -1, 0}, {1, 1, 0});
  frame.sidecar["objects"][1]["crypto"] = "3f800002";
  const float id = std::bit_cast<float>(0x3f800002);
  Floats& ids = frame.plane("CryptoObject00.b");
  Floats& shares = frame.plane("CryptoObject00.a");
  const auto cover = [&](float share, int rows) {
    for (int y = 4; y < 4 + rows; ++y)
      for (int x = 0; x < MapFrame::side; ++x) {
        ids(x, y) = id;
        shares(x, y) = share;
        frame.plane("CryptoObject00.g")(x, y) = 1.0f - share;
      }
  };
  EXPECT_EQ(said(), 0) << "covers nothing";
  cover(0.75f, 1);
  EXPECT_EQ(said(), 0) << "6 pixels are too few for a word";
  cover(0.75f, 4);
  EXPECT_EQ(said(), 1) << "24 pixels";
  frame.plane("IndexOB.X")(3, 4) = 2.0f;
  EXPECT_EQ(said(), 0) << "one pixel shows it";
  frame.plane("IndexOB.X")(3, 4) = 1.0f;
  frame.sidecar["objects"][1]["painted"] = false;
  EXPECT_EQ(said(), 0) << "a holdout";
  frame.sidecar["objects"][1].erase("painted");
  frame.sidecar["objects"][1].erase("crypto");
  EXPECT_EQ(said(), 0) << "a thing that nothing names";
}

TEST_F(EdgesAndAlpha, StrokesEndByTheirCryptomatteCoverage) {
  addCryptomatte(0.25f);
  const FrameResult result = frame.comp(transparent);
  EXPECT_NEAR(result.alpha(2, 4), 0.25f, 1e-6f);
  EXPECT_EQ(result.alpha(2, 5), 1.0f);
  const FrameResult hard = frame.comp(std::string(transparent) + "output.edges = \"pixel\"\n");
  EXPECT_EQ(hard.alpha(2, 4), 1.0f);
  const V3f whole = colourAt(hard, 2, 4), soft = colourAt(result, 2, 4);
  EXPECT_NEAR(soft.x, 0.25f * whole.x, 1e-6f) << "colour is associated";
}

TEST_F(EdgesAndAlpha, MeanNormalsSayHowMuchOfAPixelEachSideOfAThingHas) {
  addCryptomatte(1.0f);
  const V3f level(0, 0, 1), away(0.8f, 0, -0.6f);
  for (int x = 0; x < MapFrame::side; ++x) frame.setVector("Normal", x, 7, away);
  const FrameResult without = frame.comp(transparent);
  const V3f lit = colourAt(without, 4, 5), dark = colourAt(without, 4, 7);
  ASSERT_GT(lit.x - dark.x, 0.2f);
  for (int y = 0; y < MapFrame::side; ++y)
    for (int x = 0; x < MapFrame::side; ++x)
      frame.setVector("MeanNormal", x, y,
                      y == 6   ? level * 0.75f + away * 0.25f
                      : y == 7 ? away
                               : level);
  const FrameResult with = frame.comp(transparent);
  EXPECT_NEAR(colourAt(with, 4, 6).x, 0.75f * lit.x + 0.25f * dark.x, 0.03f);
  EXPECT_EQ(colourAt(with, 4, 5), lit) << "one side alone";
  const char* const pixel = "output.edges = \"pixel\"\noutput.background = \"transparent\"\n";
  EXPECT_NEAR(frame.comp(pixel).colour.x(4, 6), lit.x, 0.01f) << "as its centre shows it";
}

TEST_F(EdgesAndAlpha, TheBeautyFillsWhatTheStrokesLeave) {
  addCryptomatte(0.25f);
  const V3f behind{0.1f, 0.2f, 0.3f};
  frame.addBeauty(behind, 1.0f);
  const V3f strokes = colourAt(frame.comp(transparent), 2, 4);
  const FrameResult result = frame.comp("");
  EXPECT_EQ(result.alpha(2, 4), 1.0f);
  EXPECT_NEAR(colourAt(result, 2, 4).y, strokes.y + 0.75f * behind.y, 1e-6f);
}

// The render holds the thing as well, anti-aliased as its Cryptomatte is.
TEST_F(EdgesAndAlpha, ASilhouetteShowsEachThingOnce) {
  addCryptomatte(0.25f);
  const V3f thing{0.9f, 0.4f, 0.1f}, sky{0.1f, 0.2f, 0.3f};
  for (const float skyAlpha : {1.0f, 0.0f}) {
    frame.addBeauty(thing, 1.0f);
    for (int y = 0; y <= 4; ++y)
      for (int x = 0; x < MapFrame::side; ++x) {
        const float share = y == 4 ? 0.25f : 0.0f, open = (1 - share) * skyAlpha;
        frame.plane("Combined.R")(x, y) = share * thing.x + open * sky.x;
        frame.plane("Combined.G")(x, y) = share * thing.y + open * sky.y;
        frame.plane("Combined.B")(x, y) = share * thing.z + open * sky.z;
        frame.plane("Combined.A")(x, y) = share + open;
      }
    const V3f strokes = colourAt(frame.comp(transparent), 2, 4);
    const FrameResult result = frame.comp("");
    EXPECT_NEAR(result.alpha(2, 4), 0.25f + 0.75f * skyAlpha, 1e-6f);
    const V3f expected = strokes + sky * (0.75f * skyAlpha);
    EXPECT_NEAR(colourAt(result, 2, 4).x, expected.x, 1e-6f) << "no rim of the rendered thing";
    EXPECT_NEAR(colourAt(result, 2, 4).y, expected.y, 1e-6f);
    EXPECT_NEAR(colourAt(result, 2, 4).z, expected.z, 1e-6f);
  }
}

TEST_F(EdgesAndAlpha, ThingsThatAreNotPaintedTakeNoPaintAtTheirEdges) {
  addCryptomatte(0.25f);
  nlohmann::json post = frame.sidecar["objects"][0];
  post["name"] = "Post";
  post["index"] = 77;
  post["crypto"] = "3f900001";
  post["painted"] = false;
  frame.sidecar["objects"].push_back(post);
  const float id = std::bit_cast<float>(0x3f900001);
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x < MapFrame::side; ++x) {
      const bool meets = y == 4;
      frame.plane(meets ? "CryptoObject00.b" : "CryptoObject00.r")(x, y) = id;
      frame.plane(meets ? "CryptoObject00.a" : "CryptoObject00.g")(x, y) = meets ? 0.75f : 1.0f;
    }
  EXPECT_NEAR(frame.comp(transparent).alpha(2, 4), 0.25f, 1e-6f);
}

TEST_F(EdgesAndAlpha, OutlinesAreOpaqueInTheirColour) {
  const FrameResult result = frame.comp(std::string(transparent) +
                                        "outline.width = 3\n[[style]]\nobject = \"Thing\"\n"
                                        "outline_colour = [0.5, 0.25, 0]\n");
  EXPECT_EQ(colourAt(result, 4, 4), V3f(0.5f, 0.25f, 0.0f));
  EXPECT_EQ(result.alpha(4, 4), 1.0f);
  EXPECT_NE(colourAt(result, 4, 7), V3f(0.5f, 0.25f, 0.0f));
}

}  // namespace
}  // namespace kagefude
