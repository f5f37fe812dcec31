#include "compositor/styled_surfaces.h"
#include "compositor/test_frame.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::pointOf;
using testing::TestFrame;

/// A sheet of 24 x 16 pixels over x and y from -1 to 1 under a sun, rest positions beside it.
class StrokeGroundsTest : public ::testing::Test {
 protected:
  static constexpr int width = 24, height = 16;

  StrokeGroundsTest() {
    frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 9}, {0.6f, 0, -0.8f}, 1));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) frame.setVector("Position", x, y, skin(x, y));
  }

  static V3f skin(int x, int y) {
    return {(static_cast<float>(x) + 0.5f) / 12 - 1, 1 - (static_cast<float>(y) + 0.5f) / 8, 0.25f};
  }

  void addRest(const std::string& name, const V3f& offset = V3f(0.0f)) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) frame.setVector(name, x, y, skin(x, y) + offset);
  }

  template <class Deform>
  void deform(const Deform& deform) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) frame.setVector("Position", x, y, deform(skin(x, y)));
  }

  StyledSurfaces style(const std::string& lookText = "") {
    const std::filesystem::path path = frame.write();
    frame.folder.write("look.toml", lookText);
    const Look look = readLook(frame.folder / "look.toml", {});
    const Colour colour(look.colourConfig());
    const FramePlan plan = planFrame(look, path, 1);
    return styleSurfaces(look, StripSet(look, colour), plan, readFramePlanes(plan), warnings);
  }

  void expectSamePicture(const FrameResult& a, const FrameResult& b, float bound) {
    for (int y = 1; y + 1 < height; ++y)
      for (int x = 1; x + 1 < width; ++x)
        ASSERT_NEAR(a.colour.x(x, y), b.colour.x(x, y), bound) << x << "," << y;
  }

  TestFrame frame{width, height};
  std::vector<std::string> warnings;
};

TEST_F(StrokeGroundsTest, WithoutARestPassNothingLiesAtRest) {
  const StyledSurfaces styled = style();
  EXPECT_TRUE(styled.rest.empty());
  EXPECT_FALSE(styled.anchors[0].atRest);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(StrokeGroundsTest, PlacesHaveTheObjectsSizeButNotItsTurnOrMove) {
  // A quarter turn about Z, three times as large, and moved.
  frame.sidecar["objects"][0]["world_from_object"] = {
      {0, -3, 0, 5}, {3, 0, 0, 6}, {0, 0, 3, 7}, {0, 0, 0, 1}};
  addRest("Rest");
  const StyledSurfaces styled = style();
  ASSERT_TRUE(styled.anchors[0].atRest);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(styled.rest.view()(5, 4)[k], 3 * skin(5, 4)[k], 1e-5f) << k;
}

TEST_F(StrokeGroundsTest, ARigidThingLooksAsItDidWithoutAPass) {
  const FrameResult without = frame.comp("");
  addRest("Rest");
  expectSamePicture(without, frame.comp(""), 2e-3f);
  const FrameResult object = frame.comp("brush.ground = \"object\"\n");
  EXPECT_EQ(object.colour.x.view().pixels(), without.colour.x.view().pixels());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      ASSERT_EQ(object.colour.x(x, y), without.colour.x(x, y)) << x << "," << y;
}

// A shape key that slides the skin along itself, and grows the bounds: normals and light stay, so
// the picture does.
TEST_F(StrokeGroundsTest, AShapeKeyTakesItsStrokesAlong) {
  addRest("Rest");
  frame.sidecar["objects"][0]["rest_bounds"] = {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}};
  // Far away, so that the strokes run along X wherever the skin slides to.
  const std::string far = "[[style]]\nobject = \"*\"\nreference = [0.0, 10000.0, 0.0]\n";
  const FrameResult before = frame.comp(far);
  deform([](const V3f& p) { return V3f(p.x + 0.2f * p.x * p.x, p.y + 0.3f, p.z); });
  frame.sidecar["objects"][0]["bounds"] = {{"min", {-2, -1, -1}}, {"max", {2, 3, 1}}};
  const FrameResult after = frame.comp(far);
  expectSamePicture(before, after, 5e-3f);
  const FrameResult swimming = frame.comp("brush.ground = \"object\"\n" + far);
  float largest = 0;
  for (int x = 0; x < width; ++x)
    largest = std::max(largest, std::fabs(swimming.colour.x(x, 8) - before.colour.x(x, 8)));
  EXPECT_GT(largest, 0.02f);
}

TEST_F(StrokeGroundsTest, ZeroRestIsNamedAndThePictureIsAsWithout) {
  const FrameResult without = frame.comp("");
  for (const char* axis : {"X", "Y", "Z"}) frame.plane(std::string("Rest.") + axis, 0.0f);
  EXPECT_FALSE(style().anchors[0].atRest);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("objects hold no rest positions (Thing)"), std::string::npos);
  const FrameResult with = frame.comp("");
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      ASSERT_EQ(with.colour.x(x, y), without.colour.x(x, y)) << x << "," << y;
}

TEST_F(StrokeGroundsTest, NoAlphaAndNotFiniteAreNoRest) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const V3f p = skin(x, y);
      frame.plane("Rest.R")(x, y) = x < 12 ? p.x : std::numeric_limits<float>::quiet_NaN();
      frame.plane("Rest.G")(x, y) = p.y;
      frame.plane("Rest.B")(x, y) = p.z;
      frame.plane("Rest.A")(x, y) = x < 6 ? 1.0f : 0.0f;
    }
  const StyledSurfaces styled = style();
  ASSERT_TRUE(styled.anchors[0].atRest);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("in some of their pixels"), std::string::npos);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(styled.rest.view()(x, y)[k], skin(x, y)[k]) << "positions stand in " << x;
}

TEST_F(StrokeGroundsTest, WorldSpaceIsTakenAsItIs) {
  frame.sidecar["objects"][0]["world_from_object"][0][0] = 4;
  addRest("__WPref", {1, 2, 3});
  EXPECT_EQ(style().rest.view()(5, 4), skin(5, 4) + V3f(1, 2, 3));
  EXPECT_NE(style("frame.rest_space = \"object\"\n").rest.view()(5, 4), skin(5, 4) + V3f(1, 2, 3));
}

TEST_F(StrokeGroundsTest, BoundsAtRestSizeTheStrokes) {
  addRest("Rest");
  const float byPose = style().anchors[0].mappingDistance;
  frame.sidecar["objects"][0]["rest_bounds"] = {{"min", {-2, -2, -2}}, {"max", {2, 2, 2}}};
  EXPECT_EQ(style().anchors[0].mappingDistance, 2 * byPose);
  EXPECT_EQ(style("brush.ground = \"object\"\n").anchors[0].mappingDistance, byPose);
}

TEST_F(StrokeGroundsTest, UvsAreSizedByTheLongestSide) {
  const std::string look = "brush.ground = \"uv\"\n";
  EXPECT_THROW(style(look), InputError);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      frame.plane("UV.U")(x, y) = static_cast<float>(x + 1) / 32;
      frame.plane("UV.V")(x, y) = static_cast<float>(y) / 32;
    }
  EXPECT_EQ(style(look).rest.view()(15, 8), V3f(1.0f, 0.5f, 0));  // the sides are 2 long
  EXPECT_EQ(style(look + "brush.uv_size = 4\n").rest.view()(15, 8), V3f(2.0f, 1.0f, 0));
  EXPECT_FALSE(style(look + "brush.mapping = \"polar\"\n").anchors[0].atRest);
}

TEST_F(StrokeGroundsTest, InstancesAreShiftedAgainstEachOther) {
  addRest("Rest");
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) frame.plane("InstanceRandom.X")(x, y) = x < 12 ? 0.3f : 0.7f;
  EXPECT_EQ(style().rest.view()(3, 4), skin(3, 4)) << "one real object";
  frame.sidecar["objects"][0]["instanced"] = true;
  const StyledSurfaces styled = style();
  const V3f first = styled.rest.view()(3, 4) - skin(3, 4);
  const V3f same = styled.rest.view()(9, 7) - skin(9, 7);
  const V3f second = styled.rest.view()(15, 4) - skin(15, 4);
  EXPECT_LT((first - same).length(), 1e-4f);
  for (int k = 0; k < 3; ++k) EXPECT_GT(std::fabs(first[k] - second[k]), 0.1f) << k;
}

}  // namespace
}  // namespace kagefude
