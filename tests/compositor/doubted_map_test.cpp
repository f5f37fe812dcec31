#include <algorithm>
#include <cmath>

#include "compositor/sweep_frame.h"

namespace kagefude {
namespace {

/// A floor seen from above whose left half is in shadow, under a lamp with masks and a depth map.
struct DoubtedMap : ::testing::Test {
  static constexpr int width = 32, height = 24;

  DoubtedMap() {
    frame.layFloor();
    nlohmann::json light = testing::lightJson("Key", "point", {0, 0, 9}, {0, 0, -1}, 100);
    light["radius"] = 0.5;
    light["axes"] = {{"u", {1, 0, 0}}, {"v", {0, 1, 0}}};
    light["depth_map"] = testing::depthMapJson({0, 0, 9}, 64, 4);
    frame.sidecar["lights"].push_back(light);
    writeMap(true);
  }

  /// The map of a card over the left half, or, as of another light, over the right one.
  void writeMap(bool left) const {
    Floats depth(64, 64, 1e10f);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        if ((x < 32) == left) depth(x, y) = 7.0f;
    frame.writeDepthMap("depth.exr", depth);
  }

  /// Masks of the card at those places of the lamp, in its radii: the shadow's edge moves by a
  /// pixel.
  void addMasks(const std::string& arrangement, const std::vector<V2f>& places) {
    nlohmann::json samples = nlohmann::json::array();
    for (size_t k = 0; k < places.size(); ++k) {
      const std::string layer = "mask.Key." + std::to_string(k);
      Floats& plane = frame.plane(layer + ".V", 1.0f);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          if (float(x) + 0.5f < 16 - places[k].x) plane(x, y) = 0;
      samples.push_back({{"layer", "ViewLayer." + layer},
                         {"uv", {places[k].x, places[k].y}},
                         {"position", {0, 0, 9}}});
    }
    frame.sidecar["lights"][0]["masks"] = {
        {"arrangement", arrangement}, {"offset", 0.5}, {"samples", samples}};
  }
  void addPair() { addMasks("pair", {{1, 0}, {-1, 0}}); }
  void addDisc() { addMasks("disc", {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}); }

  /// What is said of the map.
  static std::string doubtIn(const FrameResult& result) {
    return saidIn(result, "does not fit its masks");
  }
  static std::string saidIn(const FrameResult& result, const std::string& what) {
    for (const std::string& warning : result.warnings)
      if (warning.find(what) != std::string::npos) return warning;
    return "";
  }
  void fillMasks(float value) {
    for (int k = 0; k < 5; ++k) frame.plane("mask.Key." + std::to_string(k) + ".V").fill(value);
  }
  /// The card's map, every n-th row of which is no depth.
  void spoilMap(int n) const {
    Floats depth(64, 64, 1e10f);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) depth(x, y) = y % n == 0 ? std::nanf("") : x < 32 ? 7.0f : 1e10f;
    frame.writeDepthMap("depth.exr", depth);
  }
  static bool sameTone(const FrameResult& a, const FrameResult& b) {
    for (int y = 0; y < height; ++y)
      if (!std::equal(a.colour.x.row(y), a.colour.x.row(y) + width, b.colour.x.row(y)))
        return false;
    return true;
  }

  testing::TestFrame frame{width, height};
};

TEST_F(DoubtedMap, OneThatFitsIsUsedWithoutAWord) {
  addPair();
  const FrameResult result = frame.comp("");
  EXPECT_EQ(doubtIn(result), "");
  EXPECT_FALSE(sameTone(result, frame.comp("shadow.method = \"pair\"\n")));
}

TEST_F(DoubtedMap, APairIsSearchedByItself) {
  addPair();
  writeMap(false);
  const FrameResult result = frame.comp("");
  EXPECT_NE(doubtIn(result).find("set aside"), std::string::npos);
  EXPECT_TRUE(sameTone(result, frame.comp("shadow.method = \"pair\"\n")));
  EXPECT_TRUE(sameTone(frame.comp("smooth.h = 9\n"),
                       frame.comp("shadow.method = \"pair\"\nsmooth.h = 9\n")))
      << "smoothed as a pair is";
}

TEST_F(DoubtedMap, AskedForByNameItIsUsedAndSaid) {
  addPair();
  writeMap(false);
  const FrameResult result = frame.comp("shadow.method = \"pair_depth\"\n");
  EXPECT_NE(doubtIn(result).find("used all the same"), std::string::npos);
  EXPECT_NE(doubtIn(result).find("pair_depth"), std::string::npos);
  EXPECT_FALSE(sameTone(result, frame.comp("shadow.method = \"pair\"\n")));
}

TEST_F(DoubtedMap, ADiscOfMasksDoesWithoutIt) {
  addDisc();
  const FrameResult alone = frame.comp("light_shape.depth_map = false\n");
  writeMap(false);
  for (const char* look : {"", "shadow.method = \"disc\"\n"}) {
    const FrameResult result = frame.comp(look);
    EXPECT_NE(doubtIn(result).find("set aside"), std::string::npos) << look;
    EXPECT_TRUE(sameTone(result, alone)) << look;
  }
}

TEST_F(DoubtedMap, MasksWithoutUmbraTellToo) {
  addDisc();
  fillMasks(1.0f);
  EXPECT_NE(doubtIn(frame.comp("")).find("set aside"), std::string::npos);
  frame.writeDepthMap("depth.exr", Floats(64, 64, 1e10f));
  EXPECT_EQ(doubtIn(frame.comp("")), "") << "where nothing casts";
}

TEST_F(DoubtedMap, AMapThatIsNoDepthInManyPlacesIsSetAside) {
  addDisc();
  const FrameResult alone = frame.comp("light_shape.depth_map = false\n");
  spoilMap(32);  // 2 of 64 rows
  const FrameResult result = frame.comp("");
  EXPECT_NE(saidIn(result, "is no depth (NaN or -Inf) in 128 of 4096 texels").find("set aside"),
            std::string::npos);
  EXPECT_TRUE(sameTone(result, alone));
  const FrameResult asked = frame.comp("shadow.method = \"pcss\"\n");
  EXPECT_NE(saidIn(asked, "is no depth").find("used all the same"), std::string::npos);
}

TEST_F(DoubtedMap, AFewTexelsThatAreNoDepthAreSaid) {
  addDisc();
  Floats depth(64, 64, 1e10f);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 32; ++x) depth(x, y) = 7.0f;
  depth(40, 40) = std::nanf("");
  frame.writeDepthMap("depth.exr", depth);
  EXPECT_NE(saidIn(frame.comp(""), "taken as nothing in the light's way (1 of 4096 texels)"), "");
}

TEST_F(DoubtedMap, MasksThatAreNoNumbersSpeakAgainstNoMap) {
  addDisc();
  fillMasks(std::nanf(""));
  const FrameResult result = frame.comp("");
  EXPECT_EQ(doubtIn(result), "");
  EXPECT_NE(saidIn(result, "NaN or Inf in the masks"), "");
}

TEST_F(DoubtedMap, WhatTheJsonSaysIsHeldAgainstFileAndMatrix) {
  addDisc();
  EXPECT_EQ(saidIn(frame.comp(""), "JSON"), "");
  nlohmann::json& map = frame.sidecar["lights"][0]["depth_map"];
  map["resolution"] = {5, 64};
  EXPECT_NE(
      saidIn(frame.comp(""), "of light Key has 64 x 64 texels, but the frame's JSON says 5 x 64"),
      "");
  map["resolution"] = {64, 64};
  map["projection"] = "orthographic";
  EXPECT_NE(saidIn(frame.comp(""), "orthographic, but its clip_from_light is perspective"), "");
}

}  // namespace
}  // namespace kagefude
