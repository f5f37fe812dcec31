#include "picture/png_file.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

std::string bytesOf(int width, int height) {
  PngPicture picture{width, height, 1, 8, {}};
  picture.samples.assign(static_cast<size_t>(width) * static_cast<size_t>(height), 7);
  const auto bytes = encodePng(picture, {{"key", "value"}});
  return {bytes.begin(), bytes.end()};
}

std::string chunk(const std::string& type, uint32_t size) {
  std::string text;
  for (int i = 3; i >= 0; --i) text += static_cast<char>(size >> (8 * i) & 255);
  return text + type;
}

// A file of 43 bytes took 2.1 GB and eleven seconds before it was refused.
TEST(PngFile, AChunkBeyondTheFilesEndIsRefusedByName) {
  const TestFolder folder;
  const std::string whole = bytesOf(3, 2);
  for (const std::string type : {"iCCP", "tEXt", "zTXt", "iTXt", "eXIf", "IDAT", "teST"})
    for (const uint32_t size : {uint32_t{1} << 20, uint32_t{0x7fffffff}, uint32_t{0xffffffff}}) {
      const std::string file =
          folder.write("a.png", whole.substr(0, 33) + chunk(type, size) + "ab");
      const std::string message = messageOf<InputError>([&] { readPng(file); });
      EXPECT_NE(message.find(type + " claims"), std::string::npos) << message;
      EXPECT_FALSE(readPngText(file, "key"));
    }
}

TEST(PngFile, TooManyPixelsAreRefusedByTheHeader) {
  const TestFolder folder;
  const std::string file = folder.write("a.png", bytesOf(100, 100));
  EXPECT_EQ(readPng(file, 10000).width, 100);
  EXPECT_NE(messageOf<InputError>([&] { readPng(file, 9999); }).find("100 x 100"),
            std::string::npos);
}

TEST(PngFile, TheTextOfACutFileIsNone) {
  const TestFolder folder;
  const std::string file = folder.write("a.png", bytesOf(30, 20));
  EXPECT_EQ(readPngText(file, "key"), "value");
  for (const size_t cut : {1, 12, 20}) {
    folder.write("a.png", bytesOf(30, 20));
    fs::resize_file(file, fs::file_size(file) - cut);
    EXPECT_FALSE(readPngText(file, "key")) << cut;
  }
}

}  // namespace
}  // namespace kagefude
