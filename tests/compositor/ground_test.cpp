#include <fmt/format.h>

#include <cmath>

#include "compositor/test_frame.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::TestFrame;

constexpr int width = 32, height = 24;

/// A ball in the middle, nothing behind it but the beauty, which is blue there and red on the ball.
class Ground : public ::testing::Test {
 protected:
  Ground() : frame(width, height) {
    frame.sidecar["lights"].push_back(lightJson("Key", "sun", {3, 2, 8}, {-0.5, -0.3, -0.8}, 2));
    frame.sidecar["camera"]["clip_from_camera"] = {
        {2.5, 0, 0, 0}, {0, 10.0 / 3, 0, 0}, {0, 0, -1.002, -0.2002}, {0, 0, -1, 0}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const V3f d((float(x) + 0.5f - 16) / 40, (12 - float(y) - 0.5f) / 40, -1);
        const bool ball = isBall(x, y);
        // A disc facing the camera at z = 0.
        frame.setVector("Position", x, y, ball ? V3f(d.x * 10, d.y * 10, 0) : V3f(0.0f));
        frame.setVector("Normal", x, y, ball ? V3f(0, 0, 1) : V3f(0.0f));
        frame.plane("IndexOB.X")(x, y) = ball ? 1.0f : 0.0f;
        frame.plane("Combined.R")(x, y) = ball ? 1.0f : 0.0f;
        frame.plane("Combined.G")(x, y) = 0.0f;
        frame.plane("Combined.B")(x, y) = ball ? 0.0f : 1.0f;
        frame.plane("Combined.A")(x, y) = 1.0f;
      }
  }
  static bool isBall(int x, int y) {
    const float dx = float(x) + 0.5f - 16, dy = float(y) + 0.5f - 12;
    return dx * dx + dy * dy < 64;
  }
  FrameResult comp(const std::string& look) const {
    return frame.comp(look + "[[style]]\nstrip = \"builtin:soft\"\ncolour = \"replace\"\n");
  }
  static bool same(const FrameResult& a, const FrameResult& b) {
    const auto equal = [](View<const float> p, View<const float> q) {
      return std::equal(p.data, p.data + p.pixels(), q.data);
    };
    return equal(a.colour.x, b.colour.x) && equal(a.colour.y, b.colour.y) &&
           equal(a.colour.z, b.colour.z) && equal(a.alpha, b.alpha);
  }

  TestFrame frame;
};

TEST_F(Ground, AColourStandsWhereNothingIsPainted) {
  const FrameResult r = comp("output.background = \"colour\"\nground.colour = [0.5, 0.25, 2]\n");
  EXPECT_EQ(r.colour.x(0, 0), 0.5f);
  EXPECT_EQ(r.colour.z(0, 0), 2.0f);
  EXPECT_EQ(r.alpha(0, 0), 1.0f);
  const FrameResult beauty = comp("");
  EXPECT_EQ(r.colour.y(16, 12), beauty.colour.y(16, 12));
}

TEST_F(Ground, PaperShowsItsToothAndItsColour) {
  const FrameResult r = comp("output.background = \"paper\"\npaper.colour = [0.8, 0.4, 0.2]\n");
  float lowest = 9, highest = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < 6; ++x) {
      lowest = std::min(lowest, r.colour.x(x, y));
      highest = std::max(highest, r.colour.x(x, y));
      EXPECT_NEAR(r.colour.x(x, y), 4 * r.colour.z(x, y), 1e-5f);
    }
  EXPECT_LT(lowest, 0.8f);
  EXPECT_GT(highest, 0.8f);
}

TEST_F(Ground, PaintOnPaperOverNothingLeavesHolesInAlpha) {
  const FrameResult r = comp(
      "output.background = \"transparent\"\npaper.strength = 1\npaper.pressure = 0.4\n"
      "paper.relief = 0\n");
  const FrameResult whole = comp("output.background = \"transparent\"\n");
  int bare = 0;
  for (int y = 8; y < 16; ++y)
    for (int x = 12; x < 20; ++x) {
      bare += r.alpha(x, y) < 0.1f;
      EXPECT_NEAR(r.colour.x(x, y), whole.colour.x(x, y) * r.alpha(x, y), 1e-5f);
    }
  EXPECT_GT(bare, 8);
  EXPECT_EQ(r.alpha(0, 0), 0.0f);
}

TEST_F(Ground, UnderThingsBeforeTheBeautyLiesPaperNotTheirRender) {
  const FrameResult r = comp(
      "paper.strength = 1\npaper.pressure = 0\npaper.by_tone = 0\npaper.relief = 0\n"
      "paper.colour = [0.1, 0.6, 0.3]\n");
  EXPECT_NEAR(r.colour.x(16, 12), 0.1f, 1e-5f);
  EXPECT_NEAR(r.colour.y(16, 12), 0.6f, 1e-5f);
  EXPECT_EQ(r.colour.z(0, 0), 1.0f);
  EXPECT_EQ(r.alpha(16, 12), 1.0f);
}

TEST_F(Ground, WhereRoughPaintRecedesTheBeautyGoesOnBehindIt) {
  const FrameResult r = comp("edges.rough = 3\nedges.overrun = -1\n");
  int shown = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      EXPECT_NEAR(r.alpha(x, y), 1.0f, 1e-5f);
      shown += isBall(x, y) && r.colour.z(x, y) == 1.0f && r.colour.x(x, y) == 0.0f;
    }
  EXPECT_GT(shown, 4);
}

TEST_F(Ground, EveryKeyActs) {
  const std::string strip = "output.background = \"strip\"\n";
  const auto differs = [&](const std::string& before, const std::string& after) {
    EXPECT_FALSE(same(comp(before), comp(before + after))) << after;
  };
  differs("output.background = \"colour\"\n", "ground.colour = [0.1, 0.2, 0.3]\n");
  differs(strip, "ground.strip = \"builtin:cel\"\n");
  differs(strip, "ground.row = \"view\"\n");
  differs(strip, "ground.row = \"beauty\"\n");
  differs(strip, "ground.low = 0.1\n");
  differs(strip, "ground.high = 0.9\n");
  differs(strip, "ground.width = 5\n");
  differs(strip, "ground.fixed = \"world\"\n");
}

TEST_F(Ground, APictureFillsTheFrame) {
  const Floats white(8, 6, 1.0f), black(8, 6, 0.0f);
  writePng(frame.folder / "sky.png", white, black, black);
  const FrameResult r = comp("output.background = \"picture\"\nground.picture = \"sky.png\"\n");
  EXPECT_NEAR(r.colour.x(0, 0), 1.0f, 1e-3f);
  EXPECT_NEAR(r.colour.y(31, 23), 0.0f, 1e-3f);
}

TEST_F(Ground, APictureThatIsNotNamedIsRefused) {
  try {
    comp("output.background = \"picture\"\n");
    FAIL() << "nothing was said";
  } catch (const LookError& error) {
    EXPECT_NE(std::string(error.what()).find("ground.picture"), std::string::npos);
  }
}

TEST_F(Ground, APictureThatIsMissingIsCalledByItsKey) {
  try {
    comp("output.background = \"picture\"\nground.picture = \"none.png\"\n");
    FAIL() << "nothing was said";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("look.toml:2: ground.picture: picture "),
              std::string::npos)
        << error.what();
  }
}

TEST_F(Ground, DefaultsOfItsKeysChangeNothing) {
  const FrameResult before = comp("");
  EXPECT_TRUE(same(before, comp("paper.grain = 9\nedges.overrun = 1\nground.low = 0\n"
                                "tint.shadow_strength = 1\n")));
}

TEST_F(Ground, LightsTintWhatTheyLight) {
  frame.sidecar["lights"][0]["color"] = {1.0, 0.6, 0.2};
  const FrameResult plain = comp(""), warm = comp("tint.light = 1\n");
  const auto ratio = [](const FrameResult& r) { return r.colour.x(16, 12) / r.colour.z(16, 12); };
  EXPECT_NEAR(ratio(warm) / ratio(plain), 5.0f, 0.02f);
}

}  // namespace
}  // namespace kagefude
