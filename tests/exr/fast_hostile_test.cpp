#include <OpenImageIO/imageio.h>

#include <fstream>
#include <iterator>
#include <random>

#include "base/error.h"
#include "exr/fast_fixture.h"
#include "exr/fast_read.h"
#include "source_folder.h"

namespace kagefude {
namespace {

class ExrFastHostile : public ExrFastTest {};

/// Bigger claims are left unread, to keep the test quick.
constexpr int64_t mostPixels = 1 << 16;

/// Reads all that can be read; 1 if the file was taken, 0 if left to others or refused. Anything
/// but an InputError ends the test, and the sanitizers watch the rest.
int readAll(const std::string& path) {
  try {
    const auto file = FastExr::open(path);
    if (!file) return 0;
    for (size_t p = 0; p < file->parts().size(); ++p) {
      const ExrPart& part = file->parts()[p];
      if (!part.readable || part.data.pixels() > mostPixels) continue;
      std::vector<int> wanted;
      for (size_t c = 0; c < std::min<size_t>(part.channels.size(), 8); ++c) {
        wanted.push_back(static_cast<int>(c));
      }
      file->readFloats(static_cast<int>(p), wanted);
    }
    return 1;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    return 0;
  }
}

void overwrite(const std::string& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

TEST_F(ExrFastHostile, FlippedBytesAndCutFilesNeverCrash) {
  std::mt19937 random(2024);
  for (const Imf::Compression codec :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION}) {
    for (const bool multi : {false, true}) {
      std::vector<TestPart> parts;
      for (int p = 0; p < (multi ? 2 : 1); ++p) {
        parts.push_back(makeTestPart(p == 0 ? "first" : "second", {-2, 3, 19, 21}, codec,
                                     TestPixels::smooth, static_cast<uint32_t>(p)));
      }
      writeWithOpenExr(file("good.exr"), parts);
      ASSERT_EQ(readAll(file("good.exr")), 1);
      const std::vector<char> good = contentOf(file("good.exr"));
      int refused = 0;
      for (int round = 0; round < 500; ++round) {
        std::vector<char> bad = good;
        const size_t flips = 1 + random() % 4;
        // Half of the rounds aim at the header and the table of chunks.
        const size_t reach = round % 2 ? bad.size() : std::min<size_t>(bad.size(), 700);
        for (size_t f = 0; f < flips; ++f) bad[random() % reach] = static_cast<char>(random());
        if (round % 5 == 0) bad.resize(random() % bad.size());
        overwrite(file("bad.exr"), bad);
        refused += 1 - readAll(file("bad.exr"));
      }
      EXPECT_GT(refused, 50);
    }
  }
}

TEST_F(ExrFastHostile, ASmallFileCannotClaimABigImage) {
  TestPart part = makeTestPart("", {0, 0, 16, 16}, Imf::ZIP_COMPRESSION, TestPixels::smooth, 1);
  writeWithOpenExr(file("a.exr"), {part});
  std::vector<char> bytes = contentOf(file("a.exr"));
  const std::string key("dataWindow\0box2i\0", 17);
  const auto at = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
  ASSERT_NE(at, bytes.end());
  const int32_t corner[2] = {99999, 99999};
  std::memcpy(&*at + key.size() + 4 + 8, corner, sizeof corner);
  overwrite(file("a.exr"), bytes);
  EXPECT_EQ(readAll(file("a.exr")), 0);
}

/// The files below folders; a folder that is not there has none.
std::vector<std::string> filesBelow(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> files;
  for (const std::filesystem::path& folder : folders) {
    if (!std::filesystem::is_directory(folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path().string());
  }
  return files;
}

/// Our own EXRs, which are always there; other people's are added where they are. What fuzzing found
/// among them is called damaged.
std::filesystem::path ownFiles() { return kagefude::testing::sourceFolder() / "tests/fuzz/corpus"; }

TEST_F(ExrFastHostile, TheCollectionOfDamagedFiles) {
  const auto files = filesBelow({ownFiles(), kagefude::testing::sampleFolder()});
  EXPECT_FALSE(files.empty());
  for (const std::string& path : files) {
    SCOPED_TRACE(path);
    readAll(path);
  }
}

/// Compares every channel of one part with OIIO; the number of channels.
int compareWithOiio(const std::string& path, const FastExr& file, int part) {
  const ExrPart& header = file.parts()[static_cast<size_t>(part)];
  std::vector<int> wanted;
  for (size_t c = 0; c < header.channels.size(); ++c) wanted.push_back(static_cast<int>(c));
  const auto planes = file.readFloats(part, wanted);
  const auto input = OIIO::ImageInput::open(path);
  const OIIO::ImageSpec spec = input->spec(part);
  const auto stride = static_cast<size_t>(spec.nchannels);
  std::vector<float> pixels(spec.image_pixels() * stride);
  EXPECT_TRUE(input->read_image(part, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()));
  for (size_t c = 0; c < header.channels.size(); ++c) {
    const int index = spec.channelindex(header.channels[c].name);
    EXPECT_GE(index, 0) << header.channels[c].name;
    if (index < 0 || header.channels[c].type == ExrType::uint32) continue;  // OIIO scales uints
    size_t different = 0;
    for (size_t i = 0; i < spec.image_pixels(); ++i) {
      const float* theirs = &pixels[i * stride + static_cast<size_t>(index)];
      different += std::memcmp(theirs, planes[c].row(0) + i, sizeof(float)) != 0;
    }
    EXPECT_EQ(different, 0u) << header.channels[c].name;
  }
  return static_cast<int>(header.channels.size());
}

TEST_F(ExrFastHostile, SoundFilesOfTheCollectionEqualOiio) {
  const std::filesystem::path samples = kagefude::testing::sampleFolder();
  int compared = 0;
  for (const std::string& path : filesBelow({ownFiles() / "exr_chunks", ownFiles() / "exr_header",
                                             samples / "windows", samples / "cryptomatte"})) {
    if (std::filesystem::path(path).filename().string().starts_with("damaged")) continue;
    const auto opened = FastExr::open(path);
    if (!opened) continue;
    SCOPED_TRACE(path);
    for (size_t p = 0; p < opened->parts().size(); ++p)
      if (opened->parts()[p].readable)
        compared += compareWithOiio(path, *opened, static_cast<int>(p));
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace kagefude
