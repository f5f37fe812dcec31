// Files that others made; see the README of the sample folder.
#include <sys/resource.h>

#include <algorithm>

#include "exr/read_channels.h"
#include "frame/cryptomatte.h"
#include "frame/inspect_frame.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

long peakKilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

std::vector<std::filesystem::path> filesIn(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(sampleFolder() / folder)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Reads everything that a file claims to hold; says whether that worked.
bool readsWhole(const std::filesystem::path& path) {
  try {
    const ImageFile file = openImage(path);
    for (const Channel& channel : file.channels) {
      readRaw(file, std::vector<std::string>{channel.name});
    }
    inspectFrame(path);
    return true;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos)
        << error.what();
    return false;
  }
}

TEST(SampleFiles, DamagedFilesAreReadOrRefusedWithoutGiantAllocations) {
  KAGEFUDE_NEEDS_SAMPLES();
  const long before = peakKilobytes();
  int whole = 0, refused = 0;
  for (const auto& path : filesIn("damaged")) {
    SCOPED_TRACE(path.string());
    (readsWhole(path) ? whole : refused)++;
  }
  EXPECT_GT(refused, 50);
  EXPECT_LT(peakKilobytes() - before, 1 << 20) << "more than 1 GiB";
}

TEST(SampleFiles, BombIsRefusedFromItsHeader) {
  KAGEFUDE_NEEDS_SAMPLES();
  EXPECT_THROW(openImage(sampleFolder() / "damaged/bomb.exr"), InputError);
}

TEST(SampleFiles, WindowsOfAnyPlaceAreKept) {
  KAGEFUDE_NEEDS_SAMPLES();
  for (const auto& path : filesIn("windows")) {
    SCOPED_TRACE(path.string());
    const ImageFile file = openImage(path);
    EXPECT_EQ(file.width, 400);
    EXPECT_EQ(file.height, 300);
    const auto planes = readFloats(file, std::vector<std::string>{"R", "G", "B"});
    EXPECT_EQ(planes[2].width(), 400);
  }
  EXPECT_EQ(openImage(sampleFolder() / "windows/t15.exr").displayWindow,
            (Window{-40, -40, 481, 371}));
  EXPECT_EQ(openImage(sampleFolder() / "windows/t15.exr").pixelAspect, 1.5f);
}

TEST(SampleFiles, HalfCryptomatteIsRefusedByChannelName) {
  KAGEFUDE_NEEDS_SAMPLES();
  const auto path = sampleFolder() / "cryptomatte/karma_half_ids.exr";
  const ImageFile file = openImage(path);
  expectContains(messageOf<InputError>([&] { readCryptomatte(file, "CryptoObject"); }),
                 "CryptoObject00.R as half float");
  const Inspection inspection = inspectFrame(path);
  EXPECT_TRUE(std::any_of(inspection.findings.begin(), inspection.findings.end(),
                          [](const Finding& finding) {
                            return finding.kind == FindingKind::error &&
                                   finding.what.find("CryptoObject00.R") != std::string::npos;
                          }));
}

// Every id in the picture is in the manifest, and every manifest id is its name's hash.
void expectNamesMatch(const std::string& fileName, const std::string& name, size_t names) {
  const ImageFile file = openImage(sampleFolder() / "cryptomatte" / fileName);
  const auto planes = readCryptomatte(file, name, 2);
  EXPECT_EQ(planes.names.size(), names);
  EXPECT_TRUE(planes.warnings.empty());
  for (const auto& [id, text] : planes.names) EXPECT_EQ(id, cryptomatteId(text)) << text;
  const Labels ids = dominantIds(planes);
  size_t named = 0;
  for (size_t i = 0; i < ids.view().pixels(); ++i) {
    if (ids.row(0)[i] == 0) continue;
    ASSERT_TRUE(planes.names.contains(ids.row(0)[i])) << std::hex << ids.row(0)[i];
    ++named;
  }
  EXPECT_GT(named, 100u);
}

TEST(SampleFiles, SidecarManifestIsRead) {
  KAGEFUDE_NEEDS_SAMPLES();
  expectNamesMatch("sidecar_manifest.exr", "crypto_asset", 8);
}

TEST(SampleFiles, NamesWithQuotesSlashesAndUtf8) {
  KAGEFUDE_NEEDS_SAMPLES();
  const ImageFile file = openImage(sampleFolder() / "cryptomatte/special_chars.exr");
  const auto planes = readCryptomatte(file, "special_chars");
  EXPECT_EQ(planes.names.at(0x9623511e), "равнина");
  EXPECT_EQ(planes.names.at(0xaf8bfa09), "name containing a \"quote\"  ");
  for (const auto& [id, text] : planes.names) EXPECT_EQ(id, cryptomatteId(text)) << text;
  EXPECT_EQ(planes.ids.size(), 6u);
}

TEST(SampleFiles, ArnoldPassesAreFound) {
  KAGEFUDE_NEEDS_SAMPLES();
  const ImageFile file = openImage(sampleFolder() / "cryptomatte/multichannel.exr");
  EXPECT_EQ(requireAov(file, {}, AovKind::cryptoObject).name, "crypto_object");
  EXPECT_EQ(requireAov(file, {}, AovKind::cryptoMaterial).channels.size(), 12u);
  EXPECT_EQ(requireAov(file, {}, AovKind::beauty).channels,
            (std::vector<std::string>{"R", "G", "B", "A"}));
  expectNamesMatch("multichannel.exr", "crypto_asset", 2);
}

TEST(SampleFiles, VrayPassesAndWildcardNames) {
  KAGEFUDE_NEEDS_SAMPLES();
  const ImageFile file =
      openImage(sampleFolder() / "cryptomatte/cornellBox_CryptoWildcard.0001.exr");
  EXPECT_EQ(requireAov(file, {}, AovKind::normal).name, "normals");
  const auto message = messageOf<InputError>([&] { requireAov(file, {}, AovKind::position); });
  expectContains(message, "has no Position pass");
  expectContains(message, "frame.position");
  const auto planes = readCryptomatte(file, "uCryptoWildcard", 2);
  EXPECT_EQ(matchingIds(planes.names, "[Rr]ect*").size(), 0u) << "brackets are plain characters";
  EXPECT_EQ(matchingIds(planes.names, "rect_*").size(), 2u);
  EXPECT_EQ(matchingIds(planes.names, "sphere_?_2"), (std::vector<uint32_t>{0x86de553a}));
}

}  // namespace
}  // namespace kagefude
