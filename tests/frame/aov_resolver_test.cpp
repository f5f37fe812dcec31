#include "frame/aov_resolver.h"

#include "frame/frame_fixtures.h"
#include "frame/frame_view.h"

namespace kagefude {
namespace {

using namespace testing;
using Names = std::vector<std::string>;

class AovResolver : public ::testing::Test {
 protected:
  ImageFile fileOf(const Names& channels,
                   const std::map<std::string, std::string>& attributes = {}) {
    writeChannels(folder_ / "shot.0012.exr", channels, PixelType::single, {0, 0, 2, 2}, attributes);
    return openImage(folder_ / "shot.0012.exr");
  }
  TemporaryFolder folder_;
};

Names xyz(const std::string& stem) { return {stem + ".X", stem + ".Y", stem + ".Z"}; }

Names operator+(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST_F(AovResolver, SplitsFromTheRightBecauseLayersHaveDotsAndSpaces) {
  const auto passes = listPasses(
      fileOf(xyz("View Layer.001.Position") + Names{"mask.Key.0.Shadow.R", "Depth.V", "R", "Z"}));
  const auto find = [&](const std::string& pass) {
    for (const auto& p : passes) {
      if (p.pass == pass) return p;
    }
    return PassChannels{"not found", "", "", {}};
  };
  EXPECT_EQ(find("Position").layer, "View Layer.001");
  EXPECT_EQ(find("Position").channels, xyz("View Layer.001.Position"));
  EXPECT_EQ(find("Shadow").layer, "mask.Key.0");
  EXPECT_EQ(find("Depth").layer, "");
  EXPECT_EQ(find("").channels, Names{"R"});
  EXPECT_EQ(find("Z").channels, Names{"Z"});
}

TEST_F(AovResolver, ChannelsComeInComponentOrderInAnyCase) {
  const auto file = fileOf({"a.Combined.alpha", "a.Combined.blue", "a.Combined.green",
                            "a.Combined.red", "b.Normal.x", "b.Normal.y", "b.Normal.z"});
  EXPECT_EQ(requireAov(file, {}, AovKind::beauty).channels,
            (Names{"a.Combined.red", "a.Combined.green", "a.Combined.blue", "a.Combined.alpha"}));
  EXPECT_EQ(requireAov(file, {}, AovKind::normal).channels,
            (Names{"b.Normal.x", "b.Normal.y", "b.Normal.z"}));
}

TEST_F(AovResolver, KnowsRestPositionsAndTheirSpace) {
  for (const char* name : {"Rest", "Pref", "__Pref", "rest", "ref_P", "rest_position"}) {
    EXPECT_EQ(requireAov(fileOf(xyz(name)), {}, AovKind::rest).name, name);
    EXPECT_FALSE(isWorldRest({}, name)) << name;
  }
  EXPECT_EQ(requireAov(fileOf(xyz("L.__WPref")), {}, AovKind::rest).name, "L.__WPref");
  EXPECT_TRUE(isWorldRest({}, "World.__WPref"));
  EXPECT_FALSE(isWorldRest({}, "World.Pref"));
  AovNames names;
  names.restSpace = RestSpace::world;
  EXPECT_TRUE(isWorldRest(names, "Pref"));
  EXPECT_EQ(requireAov(fileOf({"L.UV.U", "L.UV.V", "L.UV.A"}), {}, AovKind::uv).channels,
            (Names{"L.UV.U", "L.UV.V"}));
}

TEST_F(AovResolver, KnowsTheNamesOfOtherRenderers) {
  EXPECT_EQ(requireAov(fileOf(xyz("P")), {}, AovKind::position).name, "P");
  EXPECT_EQ(requireAov(fileOf(xyz("Nworld")), {}, AovKind::normal).name, "Nworld");
  EXPECT_EQ(requireAov(fileOf({"L.Object Index.X"}), {}, AovKind::objectIndex).name,
            "L.Object Index");
  EXPECT_EQ(requireAov(fileOf({"L.Diffuse Color.R", "L.Diffuse Color.G", "L.Diffuse Color.B"}), {},
                       AovKind::albedo)
                .name,
            "L.Diffuse Color");
}

TEST_F(AovResolver, EarlierNamesOfTheTableWin) {
  const auto file = fileOf(xyz("L.P") + xyz("L.Position"));
  EXPECT_EQ(requireAov(file, {}, AovKind::position).name, "L.Position");
}

TEST_F(AovResolver, TheLayerWithPositionAndNormalIsTheDataLayer) {
  const auto file = fileOf(xyz("data.Position") + xyz("data.Normal") + xyz("fg.Normal"));
  EXPECT_EQ(requireAov(file, {}, AovKind::normal).name, "data.Normal");
}

TEST_F(AovResolver, AmbiguousLayersAreAnErrorThatTheLookCanSettle) {
  const auto file = fileOf(xyz("A.Position") + xyz("B.Position"));
  const auto message = messageOf<InputError>([&] { findAov(file, {}, AovKind::position); });
  expectContains(message, "in the layers A and B; say which with frame.layer");
  AovNames names;
  names.layer = "B";
  EXPECT_EQ(requireAov(file, names, AovKind::position).name, "B.Position");
}

TEST_F(AovResolver, MaskLayersDoNotMakeAPassAmbiguous) {
  const auto file = fileOf(xyz("data.Position") + xyz("mask.Key.0.Position"));
  EXPECT_EQ(requireAov(file, {}, AovKind::position).name, "data.Position");
}

TEST_F(AovResolver, BeautyPrefersItsLayerThenBareChannels) {
  const Names bare = {"R", "G", "B"};
  const Names layered = {"fg.Combined.R", "fg.Combined.G", "fg.Combined.B"};
  EXPECT_EQ(requireAov(fileOf(bare + layered), {}, AovKind::beauty).channels, bare);
  AovNames names;
  names.beautyLayer = "fg";
  EXPECT_EQ(requireAov(fileOf(bare + layered), names, AovKind::beauty).channels, layered);
}

TEST_F(AovResolver, OverridesNamePassesOrChannels) {
  const auto file = fileOf(xyz("L.worldspace") + Names{"L.Foo.R", "L.Foo.G"});
  AovNames names;
  names.position = "L.worldspace";
  EXPECT_EQ(requireAov(file, names, AovKind::position).channels, xyz("L.worldspace"));
  names.position = "worldspace";
  EXPECT_EQ(requireAov(file, names, AovKind::position).channels, xyz("L.worldspace"));
  names.surface = "L.Foo.G";
  EXPECT_EQ(requireAov(file, names, AovKind::surface).channels, Names{"L.Foo.G"});
  names.position = "worldspaec";
  expectContains(messageOf<InputError>([&] { findAov(file, names, AovKind::position); }),
                 "has no pass worldspaec");
  names.position = "L.Foo";
  expectContains(messageOf<InputError>([&] { findAov(file, names, AovKind::position); }),
                 "only 2 of the 3 channels");
}

TEST_F(AovResolver, MissingPassListsLayersAndPasses) {
  const auto file = fileOf(xyz("ViewLayer.Normal") + Names{"ViewLayer.Depth.Z", "fg.Combined.R"});
  const auto message = messageOf<InputError>([&] { requireAov(file, {}, AovKind::position); });
  expectContains(message,
                 "shot.0012.exr has no Position pass (layers: ViewLayer and fg; passes in "
                 "ViewLayer: Depth and Normal); turn it on in the exporter or name it "
                 "with frame.position");
}

TEST_F(AovResolver, MissingPassListsThePassesThatNoTableKnows) {
  const auto file = fileOf(xyz("N") + Names{"WPP.R", "WPP.G", "WPP.B", "mask.0.Y"});
  const auto message = messageOf<InputError>([&] { requireAov(file, {}, AovKind::position); });
  expectContains(message, "passes without a layer: N and WPP; not known by name: WPP");
  expectContains(message, "name it with frame.position = \"WPP\"");
}

TEST_F(AovResolver, NearMissesAreNamed) {
  const auto message = messageOf<InputError>(
      [&] { requireAov(fileOf(xyz("ViewLayer.Positoin")), {}, AovKind::position); });
  expectContains(message, "did you mean Positoin?");
  AovNames names;
  names.layer = "ViewLayr";
  const auto layer = messageOf<InputError>(
      [&] { requireAov(fileOf(xyz("ViewLayer.Position")), names, AovKind::position); });
  expectContains(layer, "has no layer ViewLayr (did you mean ViewLayer?)");
}

TEST_F(AovResolver, ViewsAreKeptApart) {
  fileOf(xyz("L.Position.left") + xyz("L.Position.right"));
  const auto inFile = [&](const std::string& view) {
    const ImageFile file = openFrame(folder_ / "shot.0012.exr", view);
    const Aov aov = requireAov(file, {}, AovKind::position);
    EXPECT_EQ(aov.channels, xyz("L.Position"));
    return file.findChannel(aov.channels.front())->nameInPart;
  };
  EXPECT_EQ(inFile(""), "L.Position.left.X");
  EXPECT_EQ(inFile("right"), "L.Position.right.X");
}

TEST_F(AovResolver, CryptomatteChannelsComeByRank) {
  const auto file = fileOf({"L.CryptoObject00.r", "L.CryptoObject00.g", "L.CryptoObject00.b",
                            "L.CryptoObject00.a", "L.CryptoObject01.r", "L.CryptoObject01.g"});
  const Aov aov = requireAov(file, {}, AovKind::cryptoObject);
  EXPECT_EQ(aov.name, "L.CryptoObject");
  EXPECT_EQ(aov.channels,
            (Names{"L.CryptoObject00.r", "L.CryptoObject00.g", "L.CryptoObject00.b",
                   "L.CryptoObject00.a", "L.CryptoObject01.r", "L.CryptoObject01.g"}));
}

TEST_F(AovResolver, MaskLayersHaveAShadowPassOrOneChannel) {
  const auto file = fileOf({"mask.Key.0.Shadow.R", "mask.Key.0.Shadow.G", "mask.Key.0.1.Shadow.R",
                            "mask.Rim light.0.V", "mask.Two.0.A.X", "mask.Two.0.B.X"});
  EXPECT_EQ(requireMaskChannel(file, "mask.Key.0"), "mask.Key.0.Shadow.R");
  EXPECT_EQ(requireMaskChannel(file, "mask.Key.0.1"), "mask.Key.0.1.Shadow.R");
  EXPECT_EQ(requireMaskChannel(file, "mask.Rim light.0"), "mask.Rim light.0.V");
  expectContains(messageOf<InputError>([&] { requireMaskChannel(file, "mask.Kay.0"); }),
                 "did you mean mask.Key.0?");
  expectContains(messageOf<InputError>([&] { requireMaskChannel(file, "mask.Two.0"); }),
                 "has no Shadow pass in layer mask.Two.0");
}

}  // namespace
}  // namespace kagefude
