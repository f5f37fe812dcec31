#include "compositor/inspect_lights.h"

#include <cmath>

#include "compositor/test_frame.h"
#include "passes/light_shape/disc_places.h"

namespace kagefude {
namespace {

/// A floor seen from above under a lamp with nine masks, across which shadows of bars run.
struct BarredLamp : ::testing::Test {
  static constexpr int width = 128, height = 64;

  BarredLamp() { frame.layFloor(); }

  std::vector<Finding> findings(float halfBar, int bars = 3, const char* type = "point") {
    nlohmann::json light = testing::lightJson("Key", type, {0, 0, 9}, {0, 0, -1}, 100);
    light["radius"] = 0.5;
    light["axes"] = {{"u", {1, 0, 0}}, {"v", {0, 1, 0}}};
    nlohmann::json samples = nlohmann::json::array();
    const std::vector<V2f> places = discPlaces(9);
    for (size_t k = 0; k < places.size(); ++k) {
      const std::string layer = "mask.Key." + std::to_string(k);
      Floats& plane = frame.plane(layer + ".V", 1.0f);
      const auto hides = [&](float at, float shift, float place) {
        return std::fabs(at + shift * place) < halfBar;
      };
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          if (hides(float(x) - 40, 9, places[k].x) ||
              (bars > 1 && hides(float(x) - 90, 25, places[k].x)) ||
              (bars > 2 && hides(float(y) - 32, 16, places[k].y)))
            plane(x, y) = 0;
      samples.push_back({{"layer", "ViewLayer." + layer},
                         {"uv", {places[k].x, places[k].y}},
                         {"position", {0, 0, 9}}});
    }
    light["masks"] = {{"arrangement", "disc"}, {"offset", 0.5}, {"samples", samples}};
    frame.sidecar["lights"] = {light};
    Inspection inspection = inspectFrame(frame.write());
    inspection.findings.clear();
    inspectLights({}, inspection);
    return inspection.findings;
  }

  testing::TestFrame frame{width, height};
};

TEST_F(BarredLamp, ThinShadowsWantMoreMasksOrTheMap) {
  const std::vector<Finding> found = findings(1.5f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, FindingKind::warning);
  EXPECT_EQ(found[0].what.find("light Key: 9 masks are few for its thin shadows"), 0u)
      << found[0].what;
  EXPECT_EQ(found[0].remedy.find("export --masks disc:"), 0u) << found[0].remedy;
  EXPECT_NE(found[0].remedy.find("or its depth map"), std::string::npos);
}

TEST_F(BarredLamp, AreaLampsHaveNoMap) {
  const std::vector<Finding> found = findings(1.5f, 3, "area");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].remedy.find("depth map"), std::string::npos) << found[0].remedy;
}

TEST_F(BarredLamp, NothingIsSaidOfAWideShadow) { EXPECT_TRUE(findings(12, 1).empty()); }

}  // namespace
}  // namespace kagefude
