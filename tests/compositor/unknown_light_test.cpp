#include "compositor/unknown_light.h"

#include <cmath>

#include "compositor/inspect_lights.h"
#include "compositor/rendered_eye.h"
#include "compositor/sweep_frame.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

/// Masks in a part of their own, which may be cut.
struct CutMasks : ::testing::Test {
  static constexpr int width = testing::RenderedEye::width, height = testing::RenderedEye::height;

  FramePlanes read(const Window& window) {
    testing::Channels masks, rest;
    for (const auto& [name, plane] : testing::channelsOf(eye))
      (name.substr(0, 4) == "mask" ? masks : rest).emplace(name, plane);
    testing::writeParts(folder / "cut.exr", width, height,
                        {{"rest", "", rest, {}, testing::manifestOf("crypto_object")},
                         {"masks", "", masks, window}});
    testing::writeText(folder / "look.toml",
                       "[[light]]\nname = \"Lamp\"\nposition = [3.0, -3.0, 5.0]\nradius = 0.6\n"
                       "masks = [\"mask.0\", \"mask.1\"]\n");
    plan = planFrame(readLook(folder / "look.toml", {}), folder / "cut.exr", 1);
    return readFramePlanes(plan);
  }

  testing::RenderedEye eye = testing::renderEye(0);
  testing::TemporaryFolder folder;
  FramePlan plan;
};

TEST_F(CutMasks, SurfacesBeyondAreLitAndSaid) {
  const FramePlanes planes = read({0, 0, width / 2, height});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      ASSERT_EQ(planes.lights[0].masks[1](x, y), x >= width / 2 || eye.mask(x, y) >= 0.5f ? 1 : 0)
          << x << " " << y;
  ASSERT_EQ(planes.warnings.size(), 1u);
  EXPECT_EQ(planes.warnings[0].find("the masks of light Lamp cover 48 x 72 from (0, 0) of the "
                                    "frame's 96 x 72 from (0, 0) pixels only"),
            0u)
      << planes.warnings[0];
  EXPECT_EQ(maskedWindow(plan, plan.lights[0]), (Window{0, 0, width / 2, height}));
}

TEST_F(CutMasks, NothingIsSaidWhereTheyReachAllSurfaces) {
  int top = 0;
  const auto isBare = [&](int y) {
    for (int x = 0; x < width; ++x)
      if (eye.share(x, y) > 0) return false;
    return true;
  };
  while (isBare(top)) ++top;
  ASSERT_GT(top, 0);
  EXPECT_TRUE(read({0, top, width, height - top}).warnings.empty());
  EXPECT_TRUE(read({0, 0, width, height}).warnings.empty());
}

/// A floor under a lamp whose masks, or what was traced in their place, hold what is no number.
struct UnknownLight : ::testing::Test {
  static constexpr int width = 32, height = 24;

  UnknownLight() {
    frame.layFloor();
    frame.sidecar["lights"].push_back(
        testing::lightJson("Key", "point", {0, 0, 9}, {0, 0, -1}, 100));
  }
  void addPair() {
    nlohmann::json samples = nlohmann::json::array();
    for (const int k : {0, 1}) {
      const std::string layer = "mask.Key." + std::to_string(k);
      Floats& plane = frame.plane(layer + ".V", 0.0f);
      plane(3, 3) = NAN;
      plane(4 + k, 3) = k ? INFINITY : -INFINITY;
      samples.push_back(
          {{"layer", "ViewLayer." + layer}, {"uv", {k ? -1 : 1, 0}}, {"position", {0, 0, 9}}});
    }
    frame.sidecar["lights"][0]["masks"] = {
        {"arrangement", "pair"}, {"offset", 0.1}, {"samples", samples}};
    frame.sidecar["lights"][0]["axes"] = {{"u", {1, 0, 0}}, {"v", {0, 1, 0}}};
  }
  void addTraced() {
    frame.plane("traced.Key.V", 0.25f)(3, 3) = -INFINITY;
    frame.sidecar["lights"][0]["traced"] = {{"layer", "ViewLayer.traced.Key"}};
  }
  static bool says(const std::vector<std::string>& warnings, const std::string& text) {
    for (const std::string& warning : warnings)
      if (warning.find(text) != std::string::npos) return true;
    return false;
  }

  testing::TestFrame frame{width, height};
};

TEST_F(UnknownLight, MasksThatAreNoNumberAreLitAndCounted) {
  addPair();
  const FramePlanes planes = readFramePlanes(planFrame(Look(), frame.write(), 1));
  EXPECT_EQ(planes.lights[0].masks[0](3, 3), 1);
  EXPECT_EQ(planes.lights[0].masks[0](4, 3), 1);
  EXPECT_EQ(planes.lights[0].masks[0](5, 3), 0);
  EXPECT_EQ(planes.lights[0].masks[1](5, 3), 1);
  EXPECT_TRUE(says(planes.warnings,
                   "NaN or Inf in the masks of light Key is taken as lit (4 values of 2 planes)"));
}

TEST_F(UnknownLight, InspectSaysItToo) {
  addPair();
  Inspection inspection = inspectFrame(frame.write());
  inspectLights({}, inspection);
  bool found = false;
  for (const Finding& finding : inspection.findings)
    found |= finding.what.find("NaN or Inf in the masks of light Key") == 0 &&
             finding.remedy == "render them again";
  EXPECT_TRUE(found);
}

TEST_F(UnknownLight, TracedVisibilityIsLitAndCounted) {
  addTraced();
  Look look;
  look.shadow.method = ShadowMethod::traced;
  const FramePlanes planes = readFramePlanes(planFrame(look, frame.write(), 1));
  EXPECT_EQ(planes.lights[0].traced(3, 3), 1.0f);
  EXPECT_EQ(planes.lights[0].traced(4, 3), 0.25f);
  EXPECT_TRUE(says(planes.warnings,
                   "NaN or Inf in the traced visibility of light Key is taken as "
                   "lit (1 value of one plane)"));
}

}  // namespace
}  // namespace kagefude
