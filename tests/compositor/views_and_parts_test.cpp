#include "compositor/compose_frame.h"
#include "compositor/read_frame.h"
#include "compositor/rendered_eye.h"
#include "compositor/write_frame.h"
#include "frame/frame_fixtures.h"
#include "frame/frame_view.h"

namespace kagefude {
namespace {

using namespace testing;

constexpr int width = RenderedEye::width, height = RenderedEye::height;

// The look of an artist whose renderer writes no JSON.
const char* const lookText = R"(
[output]
layers = ["visibility.*", "brush.tone"]
[[light]]
name = "Lamp"
position = [3.0, -3.0, 5.0]
radius = 0.6
masks = ["mask.0", "mask.1"]
[[style]]
object = "Ball"
strip = "builtin:soft"
)";

std::string lastAfter(const std::string& name, const std::string& view) {
  const size_t dot = name.rfind('.');
  return dot == std::string::npos ? view + "." + name
                                  : name.substr(0, dot) + "." + view + name.substr(dot);
}

bool isSame(View<const float> a, View<const float> b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.data, b.data, a.pixels() * sizeof(float)) == 0;
}

class ViewsAndParts : public ::testing::Test {
 protected:
  ViewsAndParts() : left(renderEye(-0.3)), right(renderEye(0.3)) {
    writeText(folder / "look.toml", lookText);
    look = readLook(folder / "look.toml", {});
  }

  void add(Channels& all, const Channels& more) { all.insert(more.begin(), more.end()); }

  FrameResult comp(const std::string& name, const std::string& view = "") {
    const FramePlan plan = planFrame(look, folder / name, 1, view);
    const Colour colour("");
    const StripSet strips(look, colour);
    return composeFrame(look, strips, plan, readFramePlanes(plan));
  }

  void expectRightEye(const std::string& name) {
    writeParts(folder / "alone.exr", width, height,
               {{"", "", channelsOf(right), {}, manifestOf("crypto_object")}});
    const FrameResult alone = comp("alone.exr"), found = comp(name, "right");
    EXPECT_TRUE(isSame(alone.colour.x, found.colour.x));
    ASSERT_EQ(alone.layers.size(), found.layers.size());
    for (size_t i = 0; i < alone.layers.size(); ++i)
      EXPECT_TRUE(isSame(alone.layers[i].plane.floats, found.layers[i].plane.floats))
          << alone.layers[i].name;
    EXPECT_FALSE(isSame(found.colour.x, comp(name, "left").colour.x)) << "one eye twice";
  }

  TemporaryFolder folder;
  RenderedEye left, right;
  Look look;
};

TEST_F(ViewsAndParts, ViewBeforeTheLastComponentIsThatOfTheStandard) {
  Channels all = channelsOf(left);
  add(all, channelsOf(right, [](const std::string& n) { return lastAfter(n, "right"); }));
  writeParts(folder / "two.exr", width, height, {{"", "", all, {}, manifestOf("crypto_object")}},
             {"left", "right"});
  expectRightEye("two.exr");
}

TEST_F(ViewsAndParts, ViewPrefixIsNukes) {
  Channels all = channelsOf(left);
  add(all, channelsOf(right, [](const std::string& n) { return "right." + n; }));
  writeParts(folder / "two.exr", width, height, {{"", "", all, {}, manifestOf("crypto_object")}},
             {"left", "right"});
  expectRightEye("two.exr");
}

TEST_F(ViewsAndParts, PartsBelongToTheViewThatTheirHeaderNames) {
  for (const bool prefixed : {false, true}) {
    const auto names = [&](const std::string& view) {
      return [=](const std::string& n) { return prefixed ? view + "." + n : n; };
    };
    writeParts(
        folder / "two.exr", width, height,
        {{"left", "left", channelsOf(left, names("left")), {}, manifestOf("crypto_object")},
         {"right", "right", channelsOf(right, names("right")), {}, manifestOf("crypto_object")}});
    expectRightEye("two.exr");
  }
}

TEST_F(ViewsAndParts, EachViewHasItsOwnManifestAndHeader) {
  auto wrong = manifestOf("crypto_object");
  wrong["cryptomatte/f834d0a/manifest"] = R"({"Bowl":"74d3ebe9","Floor":"6a2fb16e"})";
  wrong["camera"] = "of the left eye";
  auto own = manifestOf("crypto_object");
  own["camera"] = "of the right eye";
  writeParts(folder / "two.exr", width, height,
             {{"rgba.left", "left", channelsOf(left), {}, wrong},
              {"rgba.right", "right", channelsOf(right), {}, own}});
  const FramePlan plan = planFrame(look, folder / "two.exr", 1, "right");
  EXPECT_EQ(plan.objectName(cryptomatteId("Ball")), "Ball");
  EXPECT_EQ(plan.image.text("camera"), "of the right eye");
  EXPECT_EQ(planFrame(look, folder / "two.exr", 1).objectName(cryptomatteId("Ball")), "Bowl");
  const FrameResult result = comp("two.exr", "right");
  writeFrame(look, plan, result, folder / "out.exr", {});
  EXPECT_EQ(openImage(folder / "out.exr").text("view"), "right");
  EXPECT_EQ(openImage(folder / "out.exr").text("camera"), "of the right eye");
}

TEST_F(ViewsAndParts, AViewWithoutItsOwnMaskIsAnErrorAndNotTheOtherEyesMask) {
  Channels all = channelsOf(left);
  add(all, channelsOf(right, [](const std::string& n) { return lastAfter(n, "right"); }));
  all.erase("mask.1.right.Y");
  writeParts(folder / "two.exr", width, height, {{"", "", all}}, {"left", "right"});
  expectContains(messageOf<InputError>([&] { planFrame(look, folder / "two.exr", 1, "right"); }),
                 "mask.1");
  expectContains(messageOf<InputError>([&] { planFrame(look, folder / "two.exr", 1, "rihgt"); }),
                 "has no view rihgt (did you mean right?)");
}

TEST_F(ViewsAndParts, PartsOfOtherWindowsAreJoinedAndEmptyOutside) {
  Channels picture, data;
  for (const auto& [name, plane] : channelsOf(left))
    (name.size() == 1 ? picture : data).emplace(name, plane);
  const Window inner{4, 10, 80, 60};
  writeParts(folder / "cropped.exr", width, height,
             {{"rgba", "", picture}, {"data", "", data, inner, manifestOf("crypto_object")}});
  writeParts(folder / "whole.exr", width, height,
             {{"rgba", "", picture}, {"data", "", data, {}, manifestOf("crypto_object")}});
  const FramePlan plan = planFrame(look, folder / "cropped.exr", 1);
  const FramePlanes planes = readFramePlanes(plan);
  const FramePlanes whole = readFramePlanes(planFrame(look, folder / "whole.exr", 1));
  ASSERT_EQ(planes.width, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool in = x >= 4 && y >= 10 && x < 84 && y < 70;
      ASSERT_EQ(planes.objectId(x, y), in ? whole.objectId(x, y) : 0u) << x << " " << y;
      ASSERT_EQ(planes.position.z(x, y), in ? whole.position.z(x, y) : 0.0f);
      ASSERT_EQ(planes.beauty.x(x, y), whole.beauty.x(x, y));
    }
}

TEST_F(ViewsAndParts, APartsNameIsTheLayerOfItsBareChannels) {
  const auto part = [&](const std::string& name,
                        const std::map<std::string, View<const float>>& c) {
    return PartSpec{name, "", c, {}, {}};
  };
  std::vector<PartSpec> parts = {
      part("albedo", {{"R", left.share}, {"G", left.share}, {"B", left.share}}),
      part("beauty", {{"R", left.colour}, {"G", left.colour}, {"B", left.colour}}),
      part("P", {{"X", left.position.x}, {"Y", left.position.y}, {"Z", left.position.z}}),
      part("N", {{"X", left.normal.x}, {"Y", left.normal.y}, {"Z", left.normal.z}}),
      part("crypto_object00", {{"r", left.id}, {"g", left.share}}),
      part("mask.0", {{"Y", left.mask}}),
      part("mask.1", {{"Y", left.mask}})};
  parts[4].attributes = manifestOf("crypto_object");
  writeParts(folder / "parts.exr", width, height, parts);
  const FramePlan plan = planFrame(look, folder / "parts.exr", 1);
  EXPECT_EQ(plan.albedo->channels.front(), "albedo.R");
  EXPECT_EQ(plan.beauty->channels.front(), "beauty.R");
  EXPECT_EQ(plan.objectName(cryptomatteId("Ball")), "Ball");
}

TEST_F(ViewsAndParts, EveryPartKeepsItsHeaderThroughPassthrough) {
  Channels picture, data;
  for (const auto& [name, plane] : channelsOf(left))
    (name.size() == 1 ? picture : data).emplace(name, plane);
  auto attributes = manifestOf("crypto_object");
  attributes["comment"] = "data";
  writeParts(
      folder / "parts.exr", width, height,
      {{"rgba", "", picture, {}, {{"comment", "beauty"}}}, {"data", "", data, {}, attributes}});
  look.output.passthrough = true;
  const FramePlan plan = planFrame(look, folder / "parts.exr", 1);
  writeFrame(look, plan, comp("parts.exr"), folder / "out.exr", {});
  const ImageFile out = openImage(folder / "out.exr");
  EXPECT_EQ(out.text("comment"), "beauty");
  EXPECT_EQ(out.text("data/comment"), "data");
  EXPECT_EQ(out.text("cryptomatte/f834d0a/name"), "crypto_object");
  EXPECT_NE(out.findChannel("crypto_object00.r"), nullptr);
}

TEST_F(ViewsAndParts, ObjectsNamedInFullNeedNoManifest) {
  writeParts(folder / "plain.exr", width, height, {{"", "", channelsOf(left)}});
  writeParts(folder / "named.exr", width, height,
             {{"", "", channelsOf(left), {}, manifestOf("crypto_object")}});
  EXPECT_TRUE(isSame(comp("plain.exr").colour.x, comp("named.exr").colour.x));
}

TEST_F(ViewsAndParts, MasksMayBeSingleChannelsOfAMatte) {
  Channels all = channelsOf(left);
  all.erase("mask.0.Y");
  all.erase("mask.1.Y");
  all.emplace("MultiMatte.R", left.mask);
  all.emplace("MultiMatte.G", left.mask);
  writeParts(folder / "matte.exr", width, height, {{"", "", all, {}, manifestOf("crypto_object")}});
  look.lights[0].light.masks = {"MultiMatte.R", "MultiMatte.G"};
  const FramePlan plan = planFrame(look, folder / "matte.exr", 1);
  EXPECT_EQ(plan.lights[0].maskChannels,
            (std::vector<std::string>{"MultiMatte.R", "MultiMatte.G"}));
}

}  // namespace
}  // namespace kagefude
