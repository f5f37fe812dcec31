// Lights of each kind, several of them, and lights that the look moves or describes.
#include <cmath>

#include "compositor/map_frame.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::MapFrame;
using testing::TestFrame;

class LightKinds : public ::testing::Test {
 protected:
  Floats tone(const std::string& look = "") { return frame.tone(look); }
  Floats visibility(const std::string& light, const std::string& look) {
    FrameResult result = frame.comp("output.layers = [\"visibility.*\"]\n" + look);
    return TestFrame::layer(result, "visibility." + light);
  }
  MapFrame frame;
};

TEST_F(LightKinds, ASunShadesAllPixelsAlike) {
  frame.addSun("Sun", V3f(0.6f, 0, -0.8f));
  const Floats shade = tone();
  for (int x = 0; x < MapFrame::side; ++x) EXPECT_NEAR(shade(x, 3), 0.8f, 1e-6f) << x;
}

TEST_F(LightKinds, APointShadesByTheCosineFromWhereItStands) {
  frame.addLight(lightJson("Lamp", "point", {0.125f, -0.125f, 1}, {0, 0, -1}, 100));
  const Floats shade = tone();
  EXPECT_NEAR(shade(4, 4), 1.0f, 1e-6f) << "right below";
  EXPECT_NEAR(shade(0, 4), 1 / std::sqrt(2.0f), 1e-6f) << "one unit aside, one below";
}

TEST_F(LightKinds, ASpotIsDarkOutsideItsCone) {
  nlohmann::json spot = lightJson("Spot", "spot", {0.125f, -0.125f, 1}, {0, 0, -1}, 100);
  spot["cone"] = {{"angle", 1.0}, {"blend", 0}};  // half a radian: 0.546 units on the ground
  frame.addLight(spot);
  const Floats shade = tone();
  EXPECT_NEAR(shade(4, 4), 1.0f, 1e-6f);
  EXPECT_GT(shade(6, 4), 0.8f) << "half a unit aside";
  EXPECT_EQ(shade(0, 4), 0.0f) << "a unit aside";
  EXPECT_GT(tone("shade.spot_cone = false\n")(0, 4), 0.7f);
}

TEST_F(LightKinds, AnAreaIsWholeOnItsAxis) {
  frame.addLight(lightJson("Area", "area", {0.125f, -0.125f, 2}, {0, 0, -1}, 100));
  EXPECT_NEAR(tone()(4, 4), 1.0f, 1e-6f);
}

TEST_F(LightKinds, EachLightHasItsOwnShadow) {
  frame.addLid();
  frame.addSun("Down", {0, 0, -1});
  frame.addSun("Aside", V3f(1, 0, -1).normalized());
  frame.addLight(lightJson("Lamp", "point", {0, 0, 5}, {0, 0, -1}, 100));
  frame.sidecar["lights"].back()["radius"] = 0;
  const std::string look = "shadow.method = \"coverage\"\n";
  const Floats down = visibility("Down", look), aside = visibility("Aside", look);
  const Floats lamp = visibility("Lamp", look);
  for (int x = 0; x < MapFrame::side; ++x) {
    EXPECT_EQ(down(x, 4), x < 4 ? 0.0f : 1.0f) << x;
    EXPECT_EQ(aside(x, 4), x < 4 ? 1.0f : 0.0f) << "thrown one unit to the right: " << x;
    EXPECT_EQ(lamp(x, 4), x < 4 ? 0.0f : 1.0f) << "the lid's right edge lies under it: " << x;
  }
}

TEST_F(LightKinds, MethodsMayDifferFromLightToLight) {
  frame.addLid();
  frame.addSun("Hard", {0, 0, -1});
  frame.addSun("Free", {0, 0, -1});
  const std::string look =
      "shadow.method = \"coverage\"\n[[light]]\nname = \"Free\"\nshadow.method = \"none\"\n";
  EXPECT_EQ(visibility("Hard", look)(1, 4), 0.0f);
  EXPECT_EQ(visibility("Free", look)(1, 4), 1.0f);
}

TEST_F(LightKinds, LightsAreChosenByNameAndSwitchedOff) {
  frame.addSun("Down", {0, 0, -1});
  frame.addSun("Flat", V3f(0.8f, 0, -0.6f));
  EXPECT_NEAR(tone("shadow.lights = [\"Fl*\"]\n")(4, 4), 0.6f, 1e-6f);
  EXPECT_NEAR(tone("[[light]]\nname = \"Flat\"\non = false\n")(4, 4), 1.0f, 1e-6f);
  EXPECT_NE(frame.errorOf("shadow.lights = [\"None\"]\n").find("no light takes part in frame.exr"),
            std::string::npos);
}

TEST_F(LightKinds, TwoEqualLightsShareTheTone) {
  frame.addSun("Down", {0, 0, -1});
  frame.addSun("Flat", V3f(0.8f, 0, -0.6f));
  EXPECT_NEAR(tone()(4, 4), 0.5f * 1.0f + 0.5f * 0.6f, 1e-6f);
}

TEST_F(LightKinds, AMovedLightShadesFromItsNewPlace) {
  frame.addLight(lightJson("Lamp", "point", {9, 9, 9}, {0, 0, -1}, 100));
  const Floats shade =
      tone("[[light]]\nname = \"Lamp\"\nposition = [0.125, -0.125, 1]\nshadow.method = \"none\"\n");
  EXPECT_NEAR(shade(4, 4), 1.0f, 1e-6f);
  EXPECT_NEAR(shade(0, 4), 1 / std::sqrt(2.0f), 1e-6f);
}

TEST_F(LightKinds, AMovedSunThrowsItsShadowAnew) {
  frame.addLid();
  frame.addSun("Sun", {0, 0, -1});
  const Floats moved = visibility("Sun", "[[light]]\nname = \"Sun\"\ndirection = [1, 0, -1]\n");
  for (int x = 0; x < MapFrame::side; ++x) EXPECT_EQ(moved(x, 4), x < 4 ? 1.0f : 0.0f) << x;
}

TEST_F(LightKinds, AMovedLightWithoutCastersIsRefused) {
  frame.addSun("Sun", {0, 0, -1});
  frame.addMasks("pair", {{1, 0}, {-1, 0}}, [](int, int, size_t) { return true; });
  const std::string error = frame.errorOf("[[light]]\nname = \"Sun\"\ndirection = [1, 0, -1]\n");
  EXPECT_NE(error.find("light Sun"), std::string::npos) << error;
  EXPECT_NE(error.find("--casters"), std::string::npos) << error;
}

TEST_F(LightKinds, AGreaterRadiusSoftensTheShadow) {
  frame.addLid();
  frame.addSun("Sun", {0, 0, -1});
  const Floats soft = visibility("Sun", "[[light]]\nname = \"Sun\"\nradius = 0.3\n");
  EXPECT_LT(soft(2, 4), 0.05f) << "further from both of the lid's edges than the penumbra reaches";
  EXPECT_GT(soft(7, 4), 0.95f);
  // The lid's edge lies 0.125 beside these pixels' middles: 0.243 of the disc is seen past it.
  EXPECT_NEAR(soft(3, 4), 0.243f, 0.1f);
  EXPECT_NEAR(soft(4, 4), 0.757f, 0.1f);
}

TEST_F(LightKinds, ALightOfTheLookAloneIsEnough) {
  const Floats shade =
      tone("[[light]]\nname = \"Own\"\ntype = \"sun\"\ndirection = [0.6, 0, -0.8]\n");
  EXPECT_NEAR(shade(4, 4), 0.8f, 1e-6f);
}

}  // namespace
}  // namespace kagefude
