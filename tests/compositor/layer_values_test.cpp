// Every layer that output.layers can name: its values, and that it is there only when it is asked
// for.
#include <algorithm>
#include <cmath>

#include "compositor/map_frame.h"
#include "exr/read_channels.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::MapFrame;
using testing::TestFrame;

std::vector<std::string> namesOf(const FrameResult& result) {
  std::vector<std::string> names;
  for (const NamedPlane& layer : result.layers) names.push_back(layer.name);
  std::sort(names.begin(), names.end());
  return names;
}

std::string asking(const std::string& layer) { return "output.layers = [\"" + layer + "\"]\n"; }

class LayerValues : public ::testing::Test {
 protected:
  LayerValues() { frame.addSun("Sun", {0, 0, -1}); }
  Floats layer(const std::string& name, const std::string& look = "") {
    FrameResult result = frame.comp(asking(name) + look);
    return TestFrame::layer(result, name);
  }
  void expectHalves(const Floats& plane, float left, float right) {
    for (int y = 0; y < MapFrame::side; ++y)
      for (int x = 0; x < MapFrame::side; ++x)
        ASSERT_EQ(plane(x, y), x < MapFrame::side / 2 ? left : right) << x << ", " << y;
  }
  MapFrame frame;
};

TEST_F(LayerValues, NoneUnlessAskedFor) { EXPECT_TRUE(namesOf(frame.comp("")).empty()); }

TEST_F(LayerValues, GlobsTakeAllThatTheyMatch) {
  EXPECT_EQ(namesOf(frame.comp(asking("brush.*"))),
            (std::vector<std::string>{"brush.angle", "brush.repeat", "brush.tone"}));
  frame.addSun("Rim", {1, 0, -1});
  EXPECT_EQ(namesOf(frame.comp(asking("*.Rim"))),
            (std::vector<std::string>{"confidence.Rim", "visibility.Rim"}));
}

TEST_F(LayerValues, VisibilityOfALightWithoutShadow) {
  expectHalves(layer("visibility.Sun"), 1, 1);
  expectHalves(layer("confidence.Sun"), 1, 1);
}

TEST_F(LayerValues, CoverageAndVisibilityUnderALid) {
  frame.addLid();
  const std::string look = "shadow.method = \"coverage\"\n";
  expectHalves(layer("coverage.Sun", look), 1, 0);
  expectHalves(layer("visibility.Sun", look), 0, 1);
  expectHalves(layer("confidence.Sun", look), 1, 1);
}

TEST_F(LayerValues, EveryMethodOfCastersShadesUnderTheLid) {
  frame.addLid();
  for (const char* const method : {"coverage", "volume", "places"}) {
    const Floats seen =
        layer("visibility.Sun", std::string("shadow.method = \"") + method + "\"\n");
    EXPECT_LT(seen(1, 4), 0.05f) << method;
    EXPECT_GT(seen(6, 4), 0.95f) << method;
  }
}

TEST_F(LayerValues, VisibilityAndConfidenceFromMasks) {
  // Five places on the light; all see the right half, none the left: hard, and sure.
  frame.addMasks("disc", {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}},
                 [](int x, int, size_t) { return x >= MapFrame::side / 2; });
  const Floats seen = layer("visibility.Sun");
  const Floats sure = layer("confidence.Sun");
  for (int y = 0; y < MapFrame::side; ++y) {
    EXPECT_EQ(seen(0, y), 0.0f);
    EXPECT_EQ(seen(MapFrame::side - 1, y), 1.0f);
    for (int x = 0; x < MapFrame::side; ++x) {
      EXPECT_GE(sure(x, y), 0.0f);
      EXPECT_LE(sure(x, y), 1.0f);
    }
  }
}

TEST_F(LayerValues, VisibilityFallsAcrossAPairsPenumbra) {
  // One place sees from column 2 on, the other from column 6 on.
  frame.addMasks("pair", {{1, 0}, {-1, 0}},
                 [](int x, int, size_t k) { return x >= (k == 0 ? 2 : 6); });
  const Floats seen = layer("visibility.Sun", "smooth.h = 0\n");
  EXPECT_EQ(seen(0, 4), 0.0f);
  EXPECT_EQ(seen(7, 4), 1.0f);
  for (int x = 1; x < MapFrame::side; ++x) EXPECT_GE(seen(x, 4), seen(x - 1, 4)) << x;
  EXPECT_NEAR(seen(3, 4) + seen(4, 4), 1.0f, 1e-3f) << "the penumbra's middle is half lit";
}

TEST_F(LayerValues, BrushToneIsShadeAndShadowInOne) {
  for (int y = 0; y < MapFrame::side; ++y)
    for (int x = 0; x < MapFrame::side; ++x) frame.setVector("Normal", x, y, {0.6f, 0, 0.8f});
  frame.addLid();
  const Floats tone = layer("brush.tone", "shadow.method = \"coverage\"\n");
  EXPECT_EQ(tone(1, 4), 0.0f);
  EXPECT_NEAR(tone(6, 4), 0.8f, 1e-6f);
}

TEST_F(LayerValues, AngleAndRepeatGoRoundTheReferencePoint) {
  const std::string look =
      "[brush]\nmapping = \"polar\"\n[[style]]\nobject = \"Thing\"\nreference = [0, 0, 0]\n";
  const Floats angle = layer("brush.angle", look);
  const Floats repeat = layer("brush.repeat", look);
  // Opposite pixels are half a turn apart and equally far out.
  const int last = MapFrame::side - 1;
  for (int y = 0; y < MapFrame::side; ++y)
    for (int x = 0; x < MapFrame::side; ++x) {
      const float apart = std::fabs(angle(x, y) - angle(last - x, last - y));
      EXPECT_NEAR(apart, 0.5f, 1e-4f) << x << ", " << y;
      EXPECT_NEAR(repeat(x, y), repeat(last - x, last - y), 1e-3f) << x << ", " << y;
    }
  EXPECT_GT(repeat(0, 0), repeat(3, 3));
}

TEST_F(LayerValues, OutlineRunsBetweenObjects) {
  frame.addOther();
  const Floats lines = layer("outline");
  EXPECT_GT(lines(3, 4) + lines(4, 4), 0.5f);
  EXPECT_EQ(lines(0, 4), 0.0f);
  EXPECT_EQ(lines(7, 4), 0.0f);
}

TEST_F(LayerValues, SurfaceIdsPartTheObjectsAndLeaveTheBackground) {
  frame.addOther();
  frame.clearUpperHalf();
  const FrameResult result = frame.comp(asking("surface.id"));
  ASSERT_EQ(namesOf(result), std::vector<std::string>{"surface.id"});
  const Labels& ids = result.layers[0].plane.labels;
  EXPECT_EQ(ids(0, 0), 0u);
  EXPECT_EQ(ids(0, 5), 1u);
  EXPECT_EQ(ids(7, 5), 2u);
}

TEST_F(LayerValues, AreWrittenWithTheirTypesBesideThePicture) {
  const std::string look = "output.layers = [\"visibility.*\", \"surface.id\"]\n";
  const FrameResult result = frame.comp(look);
  const Look read = readLook(frame.folder / "look.toml", {});
  const FramePlan plan = planFrame(read, frame.folder / "frame.exr", 1);
  writeFrame(read, plan, result, frame.folder / "out.exr", {{"kagefude", "test"}});
  const ImageFile written = openImage(frame.folder / "out.exr");
  EXPECT_EQ(written.findChannel("R")->type, PixelType::half);
  EXPECT_EQ(written.findChannel("visibility.Sun")->type, PixelType::single);
  EXPECT_EQ(written.findChannel("surface.id")->type, PixelType::uint);
  EXPECT_EQ(written.findChannel("ViewLayer.Normal.X"), nullptr) << "no passthrough was asked for";
  EXPECT_EQ(written.text("kagefude"), "test");
  EXPECT_EQ(readIndices(written, "surface.id")(3, 3), 1u);
}

TEST_F(LayerValues, PassthroughCarriesEveryOtherChannel) {
  const FrameResult result = frame.comp("[output]\npassthrough = true\ncolour = \"float\"\n");
  const Look read = readLook(frame.folder / "look.toml", {});
  const FramePlan plan = planFrame(read, frame.folder / "frame.exr", 1);
  writeFrame(read, plan, result, frame.folder / "out.exr", {});
  const ImageFile written = openImage(frame.folder / "out.exr");
  EXPECT_EQ(written.findChannel("R")->type, PixelType::single);
  const std::vector<std::string> name{"ViewLayer.Position.X"};
  EXPECT_EQ(readFloats(written, name)[0](5, 2), MapFrame::across(5));
}

}  // namespace
}  // namespace kagefude
