#include <cmath>

#include "compositor/test_frame.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::TestFrame;

constexpr double quarterSphere = 4 * M_PI;

/// Two pixels at the origin: the first faces +x only, the second +z only. A light from +x and a sun
/// from +z, so that each pixel's tone is one light's share.
class LightWeights : public ::testing::Test {
 protected:
  LightWeights() {
    frame.setVector("Normal", 0, 0, {1, 0, 0});
    frame.setVector("Normal", 1, 0, {0, 0, 1});
  }
  void add(const nlohmann::json& light) { frame.sidecar["lights"].push_back(light); }
  void addSun(double strength) { add(lightJson("Sun", "sun", {0, 0, 9}, {0, 0, -1}, strength)); }
  void addFromX(const std::string& type, double distance, double energy) {
    add(lightJson("Lamp", type, {float(distance), 0, 0}, {-1, 0, 0}, energy));
  }
  void setShot(const std::vector<std::pair<std::string, double>>& irradiances) {
    nlohmann::json lights = nlohmann::json::array();
    for (const auto& [name, value] : irradiances)
      lights.push_back({{"name", name}, {"irradiance", value}, {"largest_irradiance", value}});
    frame.sidecar["shot"] = {{"first", 1},
                             {"last", 9},
                             {"subject", {{"center", {0, 0, 0}}, {"radius", 1}}},
                             {"distance", 10},
                             {"lights", lights}};
  }
  /// Share of the lamp from +x, and of the sun.
  void expectShares(double lamp, double sun, const std::string& look = "") {
    const Floats tone = frame.tone(look);
    EXPECT_NEAR(tone(0, 0), lamp / (lamp + sun), 1e-5) << look;
    EXPECT_NEAR(tone(1, 0), sun / (lamp + sun), 1e-5) << look;
  }

  TestFrame frame{2};
};

TEST_F(LightWeights, PointAndSpotAgainstASun) {
  addFromX("point", 5, 100);
  addSun(0.5);
  expectShares(100 / (quarterSphere * 25), 0.5);
  frame.sidecar["lights"].erase(0);
  addFromX("spot", 2, 40);
  expectShares(40 / (quarterSphere * 4), 0.5);
}

TEST_F(LightWeights, AreaOnItsAxis) {
  addFromX("area", 5, 100);
  addSun(2);
  expectShares(1, 2);
}

TEST_F(LightWeights, AreaTurnedAsideByItsCosine) {
  nlohmann::json lamp = lightJson("Lamp", "area", {5, 0, 0}, {-0.5f, 0, std::sqrt(0.75f)}, 100);
  add(lamp);
  addSun(2);
  expectShares(0.5, 2);
}

TEST_F(LightWeights, AreaGivesNothingBehindIt) {
  add(lightJson("Lamp", "area", {5, 0, 0}, {1, 0, 0}, 100));
  addSun(2);
  expectShares(0, 2);
}

TEST_F(LightWeights, MovedLightWeighsAsItStandsNow) {
  addFromX("point", 5, 100);
  addSun(0.5);
  expectShares(100 / (quarterSphere * 100), 0.5,
               "[[light]]\nname = \"Lamp\"\nposition = [10, 0, 0]\nshadow.method = \"none\"\n");
}

TEST_F(LightWeights, MovedLightWeighsAsItStandsNowInAShot) {
  addFromX("point", 5, 100);
  addSun(0.5);
  setShot({{"Lamp", 100 / (quarterSphere * 25)}, {"Sun", 0.5}});
  expectShares(100 / (quarterSphere * 100), 0.5,
               "[[light]]\nname = \"Lamp\"\nposition = [10, 0, 0]\nshadow.method = \"none\"\n");
}

TEST_F(LightWeights, ALightOfTheLookAloneWeighsAsTheMeanOfTheOthers) {
  addSun(3);
  expectShares(3, 3, "[[light]]\nname = \"Own\"\nposition = [5, 0, 0]\n");
}

TEST_F(LightWeights, TheLookNamesAWeight) {
  addSun(3);
  expectShares(1.5, 3, "[[light]]\nname = \"Own\"\nposition = [5, 0, 0]\nweight = 1.5\n");
  expectShares(1.5, 12,
               "[[light]]\nname = \"Own\"\nposition = [5, 0, 0]\nweight = 1.5\n"
               "[[light]]\nname = \"Sun\"\nweight = 12\n");
}

TEST_F(LightWeights, OneLightReachesWhite) {
  addFromX("area", 5, 100);
  EXPECT_EQ(frame.tone("")(0, 0), 1.0f);
}

TEST_F(LightWeights, MaximumAndScreenReachWhiteWithTwoLights) {
  addFromX("area", 5, 100);  // irradiance 1
  addSun(2);
  for (const char* merge : {"maximum", "screen"}) {
    const Floats tone = frame.tone(std::string("[merge]\nlights = \"") + merge + "\"\n");
    EXPECT_NEAR(tone(0, 0), 0.5, 1e-5) << merge;
    EXPECT_EQ(tone(1, 0), 1.0f) << merge;
  }
}

TEST_F(LightWeights, ALampThatIsOffGivesNothing) {
  addFromX("point", 5, 0);
  addSun(2);
  expectShares(0, 2);
  frame.sidecar["lights"].erase(1);
  EXPECT_EQ(frame.tone("")(0, 0), 0.0f);
}

TEST_F(LightWeights, ALampIsDimmedAgainstItsShot) {
  addFromX("point", 5, 50);
  setShot({{"Lamp", 100 / (quarterSphere * 25)}});
  frame.sidecar["shot"]["lights"][0]["largest_power"] = 100;
  EXPECT_NEAR(frame.tone("")(0, 0), 0.5, 1e-5);
  frame.sidecar["lights"][0]["energy"] = 100;
  EXPECT_EQ(frame.tone("")(0, 0), 1.0f);
}

TEST_F(LightWeights, ALampWithoutShadowKeepsItsShade) {
  addFromX("point", 5, 50);
  frame.sidecar["lights"][0]["shadow"] = false;
  EXPECT_EQ(frame.tone("[shadow]\nmethod = \"disc\"\n")(0, 0), 1.0f);
}

TEST_F(LightWeights, SharesAreTheShotsAndNotTheFrames) {
  addFromX("point", 2, 100);  // nearer in this frame than over the shot
  addSun(0.5);
  setShot({{"Lamp", 0.25}, {"Sun", 0.5}});
  expectShares(0.25, 0.5);
}

TEST_F(LightWeights, OneLightLeadsTheStrokesOfAShot) {
  addFromX("point", 5, 100);
  addSun(0.5);
  setShot({{"Lamp", 0.3}, {"Sun", 0.5}});
  const std::string look = "output.layers = [\"brush.angle\"]\n";
  frame.setVector("Position", 0, 0, {0.3f, 0.4f, 0.1f});
  FrameResult before = frame.comp(look);
  frame.sidecar["lights"][0]["energy"] = 3000;  // now the lamp gives more than the sun
  FrameResult after = frame.comp(look);
  EXPECT_EQ(TestFrame::layer(before, "brush.angle")(0, 0),
            TestFrame::layer(after, "brush.angle")(0, 0));
}

TEST_F(LightWeights, EmissionOfAnAreaFallsWithItsCosineAndStopsAtItsPlane) {
  addFromX("area", 5, 100);
  frame.setVector("Position", 0, 0, {0, 5, 0});
  frame.setVector("Normal", 0, 0, V3f(1, -1, 0).normalized());
  frame.setVector("Position", 1, 0, {6, 0, 0});
  frame.setVector("Normal", 1, 0, {-1, 0, 0});
  const Floats tone = frame.tone("");
  EXPECT_NEAR(tone(0, 0), std::sqrt(0.5), 1e-5);
  EXPECT_EQ(tone(1, 0), 0.0f);
}

TEST_F(LightWeights, IrradianceFallsOffAndDims) {
  const std::string look = "[tone]\nlight = \"irradiance\"\n";
  addFromX("point", 5, 100);
  setShot({{"Lamp", 100 / (quarterSphere * 25)}});
  frame.setVector("Position", 0, 0, {-5, 0, 0});
  EXPECT_NEAR(frame.tone(look)(0, 0), 0.25, 1e-5);
  EXPECT_EQ(frame.tone("")(0, 0), 1.0f);
  frame.sidecar["lights"][0]["energy"] = 60;
  EXPECT_NEAR(frame.tone(look)(0, 0), 0.15, 1e-5);
  frame.sidecar["lights"][0]["color"] = {1, 0, 0};
  EXPECT_NEAR(frame.tone(look)(0, 0), 0.15 * 0.2126, 1e-5);
}

TEST_F(LightWeights, IrradianceOfTwoLightsAddsUp) {
  addFromX("area", 5, 100);  // 1 at the origin
  addSun(3);
  frame.setVector("Normal", 0, 0, V3f(1, 0, 1).normalized());
  const double both = (1 + 3) * std::sqrt(0.5) / 4;
  EXPECT_NEAR(frame.tone("[tone]\nlight = \"irradiance\"\n[merge]\nmode = \"product\"\n")(0, 0),
              both, 1e-5);
}

}  // namespace
}  // namespace kagefude
