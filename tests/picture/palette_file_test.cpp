#include "picture/palette_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

class PaletteFile : public ::testing::Test {
 protected:
  std::vector<V3f> read(const std::string& bytes) {
    const auto path = folder_.path() / "p";
    std::ofstream(path, std::ios::binary) << bytes;
    return readPalette(path);
  }
  TestFolder folder_;
};

std::string big(uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 255);
  return text;
}

std::string swatch(const std::string& model, const std::vector<float>& values) {
  std::string body = big(2, 2) + std::string("\0A\0\0", 4) + model;
  for (const float v : values) body += big(std::bit_cast<uint32_t>(v), 4);
  body += big(2, 2);
  return big(1, 2) + big(static_cast<uint32_t>(body.size()), 4) + body;
}

std::string swatches(const std::vector<std::string>& blocks) {
  std::string text = "ASEF" + big(0x10000, 4) + big(static_cast<uint32_t>(blocks.size()), 4);
  for (const std::string& block : blocks) text += block;
  return text;
}

void expectColour(const V3f& colour, float r, float g, float b, float within = 1e-6f) {
  EXPECT_NEAR(colour.x, r, within);
  EXPECT_NEAR(colour.y, g, within);
  EXPECT_NEAR(colour.z, b, within);
}

TEST_F(PaletteFile, GimpsByHand) {
  const auto colours = read(
      "GIMP Palette\nName: Earth\nColumns: 2\n# ochre\n255 128   0\tOchre\n\n  0 51 102 Blue\r\n");
  ASSERT_EQ(colours.size(), 2u);
  expectColour(colours[0], 1, 128 / 255.0f, 0);
  expectColour(colours[1], 0, 0.2f, 0.4f);
}

TEST_F(PaletteFile, AdobesByHand) {
  const auto colours = read(swatches({swatch("RGB ", {0.25f, 0.5f, 1}), swatch("Gray", {0.75f}),
                                      swatch("LAB ", {1, 0, 0}), swatch("LAB ", {0.5f, 0, 0})}));
  ASSERT_EQ(colours.size(), 4u);
  expectColour(colours[0], 0.25f, 0.5f, 1);
  expectColour(colours[1], 0.75f, 0.75f, 0.75f);
  expectColour(colours[2], 1, 1, 1, 2e-3f);
  // L* 50 is Y 0.184187, which sRGB encodes as 0.4663.
  expectColour(colours[3], 0.4663f, 0.4663f, 0.4663f, 2e-3f);
}

TEST_F(PaletteFile, GroupsAreNoColours) {
  const std::string group = big(0xc001, 2) + big(4, 4) + big(1, 2) + big(0, 2);
  EXPECT_EQ(read(swatches({group, swatch("Gray", {0}), big(0xc002, 2) + big(0, 4)})).size(), 1u);
}

TEST_F(PaletteFile, RefusesWhatIsNone) {
  EXPECT_THROW(read("JASC-PAL\n0100\n"), InputError);
  EXPECT_THROW(read(""), InputError);
  EXPECT_THROW(read("GIMP Palette\n#\n"), InputError);
  EXPECT_THROW(read("GIMP Palette\n256 0 0\n"), InputError);
  EXPECT_THROW(read("GIMP Palette\n1 2\n"), InputError);
  EXPECT_THROW(read(swatches({swatch("CMYK", {0, 0, 0, 1})})), InputError);
  EXPECT_THROW(read(swatches({swatch("HSV ", {0, 0, 0})})), InputError);
  EXPECT_THROW(read(swatches({swatch("RGB ", {0, NAN, 0})})), InputError);
  const std::string whole = swatches({swatch("RGB ", {0.25f, 0.5f, 1})});
  for (size_t size = 4; size + 1 < whole.size(); ++size)
    EXPECT_THROW(read(whole.substr(0, size)), InputError) << size;
  // A length far beyond the file's end is refused before anything of it is taken.
  EXPECT_THROW(read("ASEF" + big(0x10000, 4) + big(1, 4) + big(1, 2) + big(0xffffffffu, 4)),
               InputError);
  EXPECT_THROW(readPalette(folder_.path() / "missing"), InputError);
}

TEST(PaletteText, ColoursAsOneTypesThem) {
  const auto colours = paletteFromText("#ff8000, 003366,#fff");
  ASSERT_EQ(colours.size(), 3u);
  expectColour(colours[0], 1, 128 / 255.0f, 0);
  expectColour(colours[1], 0, 0.2f, 0.4f);
  expectColour(colours[2], 1, 1, 1);
  for (const char* wrong : {"", "#ff80", "red", "#gggggg", "#ff8000,,x", "#2b1d38,,#ffffff",
                            ",#fff", "#fff,", "#fff, ,#000", " ", ","})
    EXPECT_THROW(paletteFromText(wrong), UsageError) << wrong;
  EXPECT_EQ(paletteFromText(" #fff #000  , #123 ").size(), 3u);
}

}  // namespace
}  // namespace kagefude
