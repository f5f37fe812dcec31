#include "picture/picture_file.h"

#include <OpenImageIO/oiioversion.h>

#include <bit>
#include <random>

#include "frame/frame_fixtures.h"
#include "picture/cut_tiff.h"
#include "picture/strip_file.h"
#include "picture/write_picture.h"

namespace kagefude {
namespace {

using namespace testing;

/// A picture whose channels hold steps of 1/255, all different.
std::vector<Floats> someChannels(int width, int height, int count) {
  std::vector<Floats> planes;
  for (int c = 0; c < count; ++c) {
    Floats plane(width, height);
    for (int i = 0; i < width * height; ++i)
      plane.row(0)[i] = static_cast<float>((i * (c + 3) + 40 * c) % 256) / 255.0f;
    planes.push_back(std::move(plane));
  }
  return planes;
}

PictureHeader headerOf(const std::string& format, SampleType type, int channels, int width,
                       int height) {
  PictureHeader header;
  header.format = format;
  header.dataWindow = header.displayWindow = {0, 0, width, height};
  const char* const names[] = {"R", "G", "B", "A"};
  for (int c = 0; c < channels; ++c) header.channels.push_back({names[c], type});
  if (channels == 1) header.channels[0].name = "Y";
  if (channels == 4) header.alpha = 3;
  return header;
}

void writeSome(const std::filesystem::path& path, const PictureHeader& header) {
  const std::vector<Floats> planes = someChannels(header.dataWindow.width, header.dataWindow.height,
                                                  static_cast<int>(header.channels.size()));
  const std::vector<View<const float>> views(planes.begin(), planes.end());
  writePicture(path, header, views);
}

struct Kind {
  const char* format;
  const char* suffix;
};
constexpr Kind exactKinds[] = {{"tiff", "tif"}, {"targa", "tga"}, {"bmp", "bmp"}, {"dpx", "dpx"},
                               {"sgi", "sgi"},  {"iff", "iff"},   {"ico", "ico"}, {"fits", "fits"}};
constexpr Kind lossyKinds[] = {{"jpeg", "jpg"}, {"webp", "webp"}, {"heif", "heic"}, {"rla", "rla"},
                               {"gif", "gif"},  {"hdr", "hdr"},   {"pnm", "ppm"}};

TEST(PictureFile, EightBitsComeBackAsTheyWere) {
  const TemporaryFolder folder;
  const std::vector<Floats> planes = someChannels(40, 30, 3);
  for (const Kind& kind : exactKinds) {
    const auto path = folder / (std::string("a.") + kind.suffix);
    writeSome(path, headerOf(kind.format, SampleType::uint8, 3, 40, 30));
    const StripPicture strip = readStrip(path);
    ASSERT_EQ(strip.width(), 40) << kind.format;
    for (int i = 0; i < 40 * 30; ++i) {
      ASSERT_FLOAT_EQ(strip.red.row(0)[i], planes[0].row(0)[i]) << kind.format << " pixel " << i;
      ASSERT_FLOAT_EQ(strip.blue.row(0)[i], planes[2].row(0)[i]) << kind.format << " pixel " << i;
    }
  }
}

TEST(PictureFile, ChannelsAreReadInEveryForm) {
  const TemporaryFolder folder;
  for (const SampleType type : {SampleType::uint8, SampleType::uint16, SampleType::single}) {
    const auto path = folder / "a.tif";
    writeSome(path, headerOf("tiff", type, 4, 16, 8));
    PictureFile file(path);
    ASSERT_EQ(file.header().channels.size(), 4u);
    EXPECT_EQ(file.header().channels[2].type, type);
    EXPECT_EQ(file.header().format, "tiff");
    Floats values(16, 8);
    Labels words(16, 8);
    Plane<uint16_t> halves(16, 8);
    const PicturePlane wanted[] = {{1, values, {}, {}}, {1, {}, {}, words}, {1, {}, halves, {}}};
    file.read(wanted);
    const float expected = 44.0f / 255;  // (1 * 4 + 40) % 256, of the second pixel
    EXPECT_NEAR(values(1, 0), expected, 1e-4f);
    const uint32_t whole = type == SampleType::uint8    ? 44u
                           : type == SampleType::uint16 ? 44u * 257
                                                        : std::bit_cast<uint32_t>(expected);
    EXPECT_EQ(words(1, 0), whole);
    EXPECT_EQ(halves(0, 0) >> 10, halves(1, 0) >> 10) << "about 0.16 both";
  }
}

TEST(PictureFile, SaysWhetherColoursAreMultipliedByAlpha) {
  const TemporaryFolder folder;
  PictureHeader header = headerOf("tiff", SampleType::uint8, 4, 8, 8);
  writeSome(folder / "multiplied.tif", header);
  header.unassociated = true;
  writeSome(folder / "straight.tif", header);
  EXPECT_TRUE(readStrip(folder / "multiplied.tif").associated);
  EXPECT_FALSE(readStrip(folder / "straight.tif").associated);
  EXPECT_FLOAT_EQ(readStrip(folder / "straight.tif").green(1, 0), 44.0f / 255);
}

TEST(PictureFile, AttributesAreUnderOpenImageIosNames) {
  const TemporaryFolder folder;
  PictureHeader header = headerOf("tiff", SampleType::uint8, 3, 8, 8);
  header.attributes = {{"ImageDescription", "string", "a wall", {}},
                       {"XResolution", "float", "", {72}}};
  writeSome(folder / "a.tif", header);
  const PictureFile file(folder / "a.tif");
  EXPECT_EQ(file.header().text("ImageDescription"), "a wall");
  EXPECT_EQ(file.header().text("nothing"), "");
}

TEST(PictureFile, NotANumberAndWhatIsBeyondTheRangeAreHeld) {
  const TemporaryFolder folder;
  Floats plane(2, 2);
  plane(0, 0) = std::nanf("");
  plane(1, 0) = 7.0f;
  plane(0, 1) = -1.0f;
  plane(1, 1) = 0.5f;
  const View<const float> views[] = {plane};
  writePicture(folder / "a.tif", headerOf("tiff", SampleType::uint8, 1, 2, 2), views);
  const StripPicture strip = readStrip(folder / "a.tif");
  EXPECT_EQ(strip.red(0, 0), 0.0f);
  EXPECT_EQ(strip.red(1, 0), 1.0f);
  EXPECT_EQ(strip.red(0, 1), 0.0f);
  EXPECT_FLOAT_EQ(strip.red(1, 1), 128.0f / 255);
}

TEST(PictureFile, WhatCannotBeWrittenLeavesTheOlderFileAndNothingBeside) {
  const TemporaryFolder folder;
  writeText(folder / "a.xyz", "older");
  expectContains(messageOf<OutputError>([&] {
                   writeSome(folder / "a.xyz", headerOf("nothing", SampleType::uint8, 3, 8, 8));
                 }),
                 "a.xyz cannot be written");
  EXPECT_EQ(folder.names().size(), 1u);
  EXPECT_EQ(std::filesystem::file_size(folder / "a.xyz"), 5u);
}

std::string contentOf(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

TEST(PictureFile, AFileThatIsCutInHalfIsNoPicture) {
  const TemporaryFolder folder;
  std::vector<Kind> kinds(std::begin(exactKinds), std::end(exactKinds));
  kinds.insert(kinds.end(), std::begin(lossyKinds), std::end(lossyKinds));
  for (const Kind& kind : kinds) {
    const auto path = folder / (std::string("a.") + kind.suffix);
    const bool floats = kind.format == std::string("hdr");
    writeSome(path,
              headerOf(kind.format, floats ? SampleType::single : SampleType::uint8, 3, 40, 30));
    EXPECT_NO_THROW(readStrip(path)) << kind.format;
    const std::string whole = contentOf(path);
    writeText(path, whole.substr(0, whole.size() / 2));
    EXPECT_THROW(readStrip(path), InputError) << kind.format;
  }
}

// OpenImageIO unpacks what is there of ZIP strips and says nothing: half a picture came out as
// whole.
TEST(PictureFile, ATiffThatEndsWithinAnyOfItsStripsIsNoPicture) {
  const TemporaryFolder folder;
  const auto path = folder / "a.tif";
  Floats noise(64, 64);
  std::mt19937 random(7);
  for (size_t i = 0; i < noise.view().pixels(); ++i)
    noise.row(0)[i] = static_cast<float>(random() % 256) / 255.0f;
  const View<const float> grain = noise;
  writePicture(path, headerOf("tiff", SampleType::uint8, 3, 64, 64), {{grain, grain, grain}});
  EXPECT_FALSE(tiffIsCutShort(path, std::filesystem::file_size(path)));
  const std::string whole = contentOf(path);
  for (const double share : {0.2, 0.4, 0.6, 0.8, 0.95}) {
    writeText(path,
              whole.substr(0, static_cast<size_t>(share * static_cast<double>(whole.size()))));
    EXPECT_THROW(readStrip(path), InputError) << share;
  }
  writeText(path, whole.substr(0, whole.size() - 1));
  EXPECT_THROW(readStrip(path), InputError) << "a byte less";
}

TEST(PictureFile, WhatIsNoTiffIsNotCut) {
  const TemporaryFolder folder;
  for (const std::string& text :
       {std::string(), std::string("II"), std::string("text of no picture")}) {
    writeText(folder / "a.tif", text);
    EXPECT_FALSE(tiffIsCutShort(folder / "a.tif", text.size())) << text;
  }
}

/// Every way of damage gives one sentence that names the file, or a picture still.
size_t refusals(const std::filesystem::path& path, const std::string& good, std::mt19937& random) {
  size_t refused = 0;
  for (int round = 0; round < 12; ++round) {
    std::string bad = good;
    if (round % 3 == 0)
      bad.resize(random() % bad.size());
    else
      for (int flips = 0; flips < round; ++flips)
        bad[random() % (round % 2 ? std::min<size_t>(bad.size(), 128) : bad.size())] =
            static_cast<char>(random());
    writeText(path, bad);
    try {
      readStrip(path);
    } catch (const InputError& error) {
      const std::string words = error.what();
      EXPECT_NE(words.find(path.filename().string()), std::string::npos) << words;
      EXPECT_EQ(words.find('\n'), std::string::npos) << words;
      ++refused;
    }
  }
  return refused;
}

TEST(PictureFile, DamageOfAnyFormatIsOneSentenceOrAPicture) {
  const TemporaryFolder folder;
  std::mt19937 random(15);
  std::vector<Kind> kinds(std::begin(exactKinds), std::end(exactKinds));
  kinds.insert(kinds.end(), std::begin(lossyKinds), std::end(lossyKinds));
  for (const Kind& kind : kinds) {
    const auto path = folder / (std::string("a.") + kind.suffix);
    writeSome(path,
              headerOf(kind.format,
                       kind.format == std::string("hdr") ? SampleType::single : SampleType::uint8,
                       3, 40, 30));
    EXPECT_GE(refusals(path, contentOf(path), random), 2u) << kind.format;
  }
  // The worker that read damaged files, or its successor, still reads good ones.
  writeSome(folder / "good.tif", headerOf("tiff", SampleType::uint8, 3, 40, 30));
  EXPECT_EQ(readStrip(folder / "good.tif").width(), 40);
}

TEST(PictureFile, ADecoderThatDiesIsASentence) {
  // OpenImageIO 2.4 crashes on a run of no pixels in a Softimage picture.
  const TemporaryFolder folder;
  std::string picture("\x53\x80\xF6\x34\x40\x6d\x70\xa4", 8);
  picture += std::string(80, '\0') + "PICT" + std::string("\0\x40\0\x40\x3f\x80\0\0\0\3\0\0", 12);
  picture += std::string("\0\x08\1\xe0", 4) + std::string(20000, '\0');
  writeText(folder / "a.pic", picture);
  const std::string words = messageOf<InputError>([&] { readStrip(folder / "a.pic"); });
  expectContains(words, "a.pic");
  writeSome(folder / "good.tif", headerOf("tiff", SampleType::uint8, 3, 4, 4));
  EXPECT_EQ(readStrip(folder / "good.tif").width(), 4);
}

TEST(PictureFile, AClaimThatTheFileCannotHoldIsRefusedBeforeItIsAllocated) {
  const TemporaryFolder folder;
  // An uncompressed TGA of 60,000 x 60,000 in a few bytes.
  std::string tga(18, '\0');
  tga[2] = 2;
  for (const int at : {12, 14}) {
    tga[static_cast<size_t>(at)] = '\x60';
    tga[static_cast<size_t>(at) + 1] = '\xEA';
  }
  tga[16] = 24;
  writeText(folder / "a.tga", tga + std::string(1000, 'x'));
  // OpenImageIO 3.1 counts by itself.
  expectContains(messageOf<InputError>([&] { readStrip(folder / "a.tga"); }),
                 OIIO_VERSION < 30100 ? "60000 x 60000" : "10800000000 bytes");
}

}  // namespace
}  // namespace kagefude
