// Frames as other renderers write them, and damaged ones, made here. sample_files_test.cpp reads
// what others really wrote.
#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <random>

#include "exr/read_channels.h"
#include "frame/cryptomatte.h"
#include "frame/frame_fixtures.h"
#include "frame/inspect_frame.h"

namespace kagefude {
namespace {

using namespace testing;
using Attributes = std::map<std::string, std::string>;

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

long peakKilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// Reads everything that a file claims to hold; says whether that worked.
bool readsWhole(const std::filesystem::path& path) {
  try {
    const ImageFile file = openImage(path);
    for (const Channel& channel : file.channels)
      readRaw(file, std::vector<std::string>{channel.name});
    inspectFrame(path);
    return true;
  } catch (const InputError& error) {
    expectContains(error.what(), path.filename().string());
    return false;
  }
}

/// A frame with a Cryptomatte and its manifest, in one of the codecs.
void writeFrame(const std::filesystem::path& path, Compression compression) {
  const Floats values(40, 30, 0.5f);
  OutputImage image;
  image.dataWindow = image.displayWindow = {-3, 5, 40, 30};
  image.compression = compression;
  image.attributes = {{"cryptomatte/ab12/name", "L.CryptoObject"},
                      {"cryptomatte/ab12/manifest", R"({"Cup":"0000abcd"})"}};
  for (const char* const name : {"L.Position.X", "L.Position.Y", "L.Position.Z",
                                 "L.CryptoObject00.r", "L.CryptoObject00.g", "R", "G", "B"})
    image.channels.push_back(floatChannel(name, PixelType::single, values));
  writeExr(path, image);
}

TEST(ForeignFiles, DamagedFramesAreReadOrRefusedWithoutGiantAllocations) {
  const TemporaryFolder folder;
  std::mt19937 random(11);
  const long before = peakKilobytes();
  for (const Compression codec : {Compression::none, Compression::rle, Compression::zips,
                                  Compression::zip, Compression::piz}) {
    writeFrame(folder / "good.exr", codec);
    ASSERT_TRUE(readsWhole(folder / "good.exr"));
    const std::string good = contentOf(folder / "good.exr");
    int refused = 0;
    for (int round = 0; round < 60; ++round) {
      std::string bad = good;
      const size_t reach = round % 2 ? bad.size() : std::min<size_t>(bad.size(), 900);
      for (int flips = 0; flips < 3; ++flips) bad[random() % reach] = static_cast<char>(random());
      if (round % 4 == 0) bad.resize(random() % bad.size());
      writeText(folder / "bad.exr", bad);
      refused += !readsWhole(folder / "bad.exr");
    }
    EXPECT_GT(refused, 15) << static_cast<int>(codec);
  }
  EXPECT_LT(peakKilobytes() - before, 1 << 20) << "more than 1 GiB";
}

TEST(ForeignFiles, ABombIsRefusedFromItsHeader) {
  const TemporaryFolder folder;
  writeFrame(folder / "bomb.exr", Compression::zip);
  std::string bytes = contentOf(folder / "bomb.exr");
  const std::string key("dataWindow\0box2i\0", 17);
  const size_t corner = bytes.find(key) + key.size() + 4 + 8;
  const int32_t farAway[2] = {29999, 29999};
  std::copy_n(reinterpret_cast<const char*>(farAway), sizeof farAway, bytes.begin() + corner);
  writeText(folder / "bomb.exr", bytes);
  expectContains(messageOf<InputError>([&] { openImage(folder / "bomb.exr"); }), "bomb.exr");
}

TEST(ForeignFiles, WindowsOfAnyPlaceAreKept) {
  const TemporaryFolder folder;
  const Floats values(40, 30, 0.25f);
  // Inside, across and beyond the display window; the last with overscan and long pixels.
  const Window displays[] = {
      {0, 0, 80, 60}, {20, 10, 40, 30}, {500, 500, 40, 30}, {-4, -4, 48, 37}};
  for (const Window& display : displays) {
    OutputImage image;
    image.dataWindow = {0, 0, 40, 30};
    image.displayWindow = display;
    image.pixelAspect = 1.5f;
    image.channels = {floatChannel("R", PixelType::half, values)};
    writeExr(folder / "window.exr", image);
    const ImageFile file = openImage(folder / "window.exr");
    EXPECT_EQ(file.dataWindow, image.dataWindow);
    EXPECT_EQ(file.displayWindow, display);
    EXPECT_EQ(file.pixelAspect, 1.5f);
    EXPECT_EQ(readFloats(file, std::vector<std::string>{"R"})[0].width(), 40);
  }
}

TEST(ForeignFiles, AHalfCryptomatteIsRefusedByChannelName) {
  const TemporaryFolder folder;
  const std::vector<std::string> channels = {"CryptoObject00.R", "CryptoObject00.G",
                                             "CryptoObject00.B", "CryptoObject00.A"};
  writeChannels(folder / "karma.exr", channels, PixelType::half);
  expectContains(messageOf<InputError>(
                     [&] { readCryptomatte(openImage(folder / "karma.exr"), "CryptoObject"); }),
                 "CryptoObject00.R as half float");
  const Inspection inspection = inspectFrame(folder / "karma.exr");
  EXPECT_TRUE(std::any_of(inspection.findings.begin(), inspection.findings.end(),
                          [](const Finding& finding) {
                            return finding.kind == FindingKind::error &&
                                   finding.what.find("CryptoObject00.R") != std::string::npos;
                          }));
}

const std::vector<std::string> strangeNames = {
    "равнина", "a \"quoted\" name  ", "back\\slash", "/path/of/a/thing", "ball_asset", "日本"};

/// One pixel a name, each wholly covered by its id; ranks with upper-case channel names.
void writeCryptomatte(const std::filesystem::path& path, const std::string& layer,
                      const std::vector<std::string>& names, const Attributes& attributes) {
  const int width = static_cast<int>(names.size());
  Floats ids(width, 1), whole(width, 1, 1.0f), nothing(width, 1, 0.0f);
  for (int x = 0; x < width; ++x)
    ids(x, 0) = std::bit_cast<float>(cryptomatteId(names[static_cast<size_t>(x)]));
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, width, 1};
  image.attributes = attributes;
  image.channels = {floatChannel(layer + "00.R", PixelType::single, ids),
                    floatChannel(layer + "00.G", PixelType::single, whole),
                    floatChannel(layer + "00.B", PixelType::single, nothing),
                    floatChannel(layer + "00.A", PixelType::single, nothing)};
  writeExr(path, image);
}

TEST(ForeignFiles, NamesWithQuotesSlashesAndUtf8ComeFromAFileBeside) {
  const TemporaryFolder folder;
  std::string manifest = "{";
  for (const std::string& name : strangeNames) {
    std::string escaped;
    for (const char c : name)
      escaped += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    char id[9];
    std::snprintf(id, sizeof id, "%08x", cryptomatteId(name));
    manifest += (manifest.size() > 1 ? ",\"" : "\"") + escaped + "\":\"" + id + "\"";
  }
  writeText(folder / "names.json", manifest + "}");
  writeCryptomatte(folder / "a.exr", "crypto_asset", strangeNames,
                   {{"cryptomatte/834e205/name", "crypto_asset"},
                    {"cryptomatte/834e205/manif_file", "names.json"},
                    {"cryptomatte/834e205/hash", "MurmurHash3_32"},
                    {"cryptomatte/834e205/conversion", "uint32_to_float32"}});
  const auto planes = readCryptomatte(openImage(folder / "a.exr"), "crypto_asset");
  EXPECT_TRUE(planes.warnings.empty());
  EXPECT_EQ(planes.names.size(), strangeNames.size());
  EXPECT_EQ(planes.names.at(0x9623511e), "равнина") << "the id that Cryptomatte's samples have";
  const Labels ids = dominantIds(planes);
  for (size_t i = 0; i < strangeNames.size(); ++i)
    EXPECT_EQ(planes.names.at(ids.row(0)[i]), strangeNames[i]);
}

TEST(ForeignFiles, BracketsInPatternsArePlainCharacters) {
  std::map<uint32_t, std::string> names;
  for (const char* const name : {"rect_1", "rect_2", "sphere_1_2", "Rect"})
    names.emplace(cryptomatteId(name), name);
  EXPECT_EQ(matchingIds(names, "[Rr]ect*").size(), 0u);
  EXPECT_EQ(matchingIds(names, "rect_*").size(), 2u);
  EXPECT_EQ(matchingIds(names, "sphere_?_2"), std::vector<uint32_t>{cryptomatteId("sphere_1_2")});
}

TEST(ForeignFiles, ArnoldsAndVraysPassesAreFound) {
  const TemporaryFolder folder;
  std::vector<std::string> channels = {"A", "B", "G", "R"};
  for (const char* const layer : {"crypto_object", "crypto_material", "crypto_asset"})
    for (int rank = 0; rank < 3; ++rank)
      for (const char c : {'R', 'G', 'B', 'A'})
        channels.push_back(std::string(layer) + "0" + std::to_string(rank) + "." + c);
  writeChannels(folder / "arnold.exr", channels);
  const ImageFile arnold = openImage(folder / "arnold.exr");
  EXPECT_EQ(requireAov(arnold, {}, AovKind::cryptoObject).name, "crypto_object");
  EXPECT_EQ(requireAov(arnold, {}, AovKind::cryptoMaterial).channels.size(), 12u);
  EXPECT_EQ(requireAov(arnold, {}, AovKind::beauty).channels,
            (std::vector<std::string>{"R", "G", "B", "A"}));
  writeChannels(folder / "vray.exr", {"R", "G", "B", "normals.X", "normals.Y", "normals.Z"});
  const ImageFile vray = openImage(folder / "vray.exr");
  EXPECT_EQ(requireAov(vray, {}, AovKind::normal).name, "normals");
  const auto message = messageOf<InputError>([&] { requireAov(vray, {}, AovKind::position); });
  expectContains(message, "has no Position pass");
  expectContains(message, "frame.position");
}

}  // namespace
}  // namespace kagefude
