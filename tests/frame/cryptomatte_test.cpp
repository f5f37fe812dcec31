#include "frame/cryptomatte.h"

#include <bit>
#include <cmath>

#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

const std::vector<std::string> levelChannels = {"L.CryptoObject00.r", "L.CryptoObject00.g",
                                                "L.CryptoObject00.b", "L.CryptoObject00.a"};

TEST(MurmurHash3, KnownValues) {
  // Values of the reference implementation, as published in its test vectors.
  EXPECT_EQ(murmurHash3(""), 0u);
  EXPECT_EQ(murmurHash3("", 1), 0x514E28B7u);
  EXPECT_EQ(murmurHash3("a", 0x9747b28cu), 0x7FA09EA6u);
  EXPECT_EQ(murmurHash3("aaaa", 0x9747b28cu), 0x5A97808Au);
  EXPECT_EQ(murmurHash3("Hello, world!", 0x9747b28cu), 0x24884CBAu);
}

TEST(CryptomatteId, IsTheHashOfTheName) {
  // From manifests that Arnold and V-Ray wrote.
  EXPECT_EQ(cryptomatteId("ball_asset"), 0x79b62f5eu);
  EXPECT_EQ(cryptomatteId("default"), 0x42c9679fu);
}

TEST(CryptomatteId, IsNeverADenormalZeroOrNan) {
  EXPECT_EQ(cryptomatteId(""), 1u << 23) << "hash 0 would be the background";
  for (int i = 0; i < 20000; ++i) {
    const auto id = cryptomatteId("object" + std::to_string(i));
    ASSERT_TRUE(std::isnormal(std::bit_cast<float>(id))) << i;
  }
}

TEST(MatchingIds, PlainNamesWorkWithoutAManifest) {
  EXPECT_EQ(matchingIds({}, "Cup"), std::vector<uint32_t>{cryptomatteId("Cup")});
  EXPECT_TRUE(matchingIds({}, "Cup*").empty());
  EXPECT_EQ(matchingIds({{7, "Cup"}, {9, "Can"}, {11, "Pot"}}, "C*"),
            (std::vector<uint32_t>{7, 9}));
}

CryptomattePlanes onePixel(const std::vector<std::pair<uint32_t, float>>& ranks) {
  CryptomattePlanes planes;
  for (const auto& [id, coverage] : ranks) {
    planes.ids.emplace_back(1, 1, id);
    planes.coverage.emplace_back(1, 1, coverage);
  }
  return planes;
}

TEST(DominantIds, TakesTheLargestCoverage) {
  EXPECT_EQ(dominantIds(onePixel({{5, 0.25f}, {6, 0.75f}}))(0, 0), 6u);
  EXPECT_EQ(dominantIds(onePixel({{5, 0.5f}, {6, 0.5f}}))(0, 0), 5u) << "the lower rank wins ties";
  EXPECT_EQ(dominantIds(onePixel({{5, 0.0f}}))(0, 0), 0u) << "no coverage is background";
  EXPECT_EQ(dominantIds(onePixel({{5, std::nanf("")}, {6, 0.1f}}))(0, 0), 6u);
  EXPECT_TRUE(dominantIds({}).empty());
}

class CryptomatteFile : public ::testing::Test {
 protected:
  ImageFile fileOf(const std::map<std::string, std::string>& attributes) {
    writeChannels(folder_ / "a.exr", levelChannels, PixelType::single, {0, 0, 2, 2}, attributes);
    return openImage(folder_ / "a.exr");
  }
  std::map<std::string, std::string> named(const std::string& key, const std::string& value) {
    return {{"cryptomatte/ab12/name", "L.CryptoObject"}, {"cryptomatte/ab12/" + key, value}};
  }
  TemporaryFolder folder_;
};

TEST_F(CryptomatteFile, IsFoundByChannelsAlone) {
  const auto planes = readCryptomatte(fileOf({}), "CryptoObject");
  ASSERT_EQ(planes.ids.size(), 2u);
  EXPECT_EQ(planes.ids[1](1, 1), std::bit_cast<uint32_t>(203.0f)) << "bits, not numbers";
  EXPECT_EQ(planes.coverage[1](1, 1), 303.0f);
  ASSERT_EQ(planes.warnings.size(), 1u);
  expectContains(planes.warnings[0], "has no manifest");
}

TEST_F(CryptomatteFile, RanksCanBeLimited) {
  EXPECT_EQ(readCryptomatte(fileOf({}), "L.CryptoObject", 1).ids.size(), 1u);
}

TEST_F(CryptomatteFile, ManifestGivesNames) {
  const auto planes =
      readCryptomatte(fileOf(named("manifest", R"({"Cup":"0000abcd","Bad":7})")), "CryptoObject");
  EXPECT_EQ(planes.names, (std::map<uint32_t, std::string>{{0xabcd, "Cup"}}));
  ASSERT_EQ(planes.warnings.size(), 1u);
  expectContains(planes.warnings[0], "1 entries without a hexadecimal id");
}

TEST_F(CryptomatteFile, BrokenManifestsAreWarnings) {
  for (const char* text : {"", "{\"Cup\":", "[1,2]", "\xff\xfe"}) {
    const auto planes = readCryptomatte(fileOf(named("manifest", text)), "CryptoObject");
    EXPECT_TRUE(planes.names.empty());
    EXPECT_EQ(planes.warnings.size(), 1u) << text;
  }
}

TEST_F(CryptomatteFile, ManifestFilesOutsideTheFolderAreNotOpened) {
  const TemporaryFolder outside;
  writeText(outside / "m.json", R"({"Secret":"0000abcd"})");
  const std::string name = outside.path().filename().string();
  for (const std::string& path :
       {(outside / "m.json").string(), "../" + name + "/m.json", std::string("C:\\m.json")}) {
    const auto planes = readCryptomatte(fileOf(named("manif_file", path)), "CryptoObject");
    EXPECT_TRUE(planes.names.empty());
    ASSERT_EQ(planes.warnings.size(), 1u);
    expectContains(planes.warnings[0], "leaves the image's folder");
  }
  writeText(folder_ / "m.json", R"({"Cup":"0000abcd"})");
  EXPECT_EQ(readCryptomatte(fileOf(named("manif_file", "m.json")), "CryptoObject").names.size(),
            1u);
}

TEST_F(CryptomatteFile, TellsWhichFileItsNamesComeFrom) {
  const auto sourceOf = [&](const std::map<std::string, std::string>& attributes) {
    const ImageFile file = fileOf(attributes);
    return manifestFile(file, listCryptomattes(file).at(0));
  };
  EXPECT_EQ(sourceOf(named("manif_file", "m.json")), folder_ / "m.json");
  EXPECT_FALSE(sourceOf(named("manifest", "{}")));
  EXPECT_FALSE(sourceOf(named("manif_file", "../m.json")));
  EXPECT_FALSE(sourceOf(named("manif_file", "")));
}

TEST_F(CryptomatteFile, OtherHashesAreRefused) {
  expectContains(messageOf<InputError>(
                     [&] { readCryptomatte(fileOf(named("hash", "CRC32")), "CryptoObject"); }),
                 "whose hash is CRC32");
}

TEST_F(CryptomatteFile, UnknownNamesListWhatThereIs) {
  expectContains(messageOf<InputError>([&] { readCryptomatte(fileOf({}), "L.CryptoObjct"); }),
                 "has no Cryptomatte L.CryptoObjct (did you mean L.CryptoObject?)");
}

}  // namespace
}  // namespace kagefude
