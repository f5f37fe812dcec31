#include "exr/header_claims.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "exr/fast_read.h"
#include "exr/image_file.h"
#include "exr/write_image.h"
#include "image/plane.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

const std::string start{"\x76\x2f\x31\x01\x02\x00\x00\x00", 8};

std::string attribute(const std::string& name, const std::string& type, uint32_t size) {
  std::string text = name + '\0' + type + '\0';
  for (int i = 0; i < 4; ++i) text += static_cast<char>(size >> (8 * i) & 255);
  return text;
}

// Files of 22 and 30 bytes took 2.1 GB and ten seconds each before they were refused.
TEST(HeaderClaims, AnAttributeBeyondTheFilesEndIsRefusedByName) {
  const TestFolder folder;
  for (const std::string type : {"string", "floatvector", "preview", "chlist", "opaque"})
    for (const uint32_t size : {uint32_t{1} << 20, uint32_t{0x7fffffff}, uint32_t{0xffffffff}}) {
      const std::string file = folder.write("a.exr", start + attribute("owner", type, size));
      for (const std::string& message : {messageOf<InputError>([&] { openImage(file); }),
                                         messageOf<InputError>([&] { FastExr::open(file); })})
        EXPECT_NE(message.find("attribute owner claims"), std::string::npos) << type << message;
    }
}

// OpenEXR reads these by their contents: found by fuzzing, a list of channels that went on beyond
// its size let the bytes behind it claim 1.7 GB.
TEST(HeaderClaims, AValueThatDoesNotEndWhereItsSizeSaysIsRefusedByName) {
  const TestFolder folder;
  const std::string channel = std::string("A") + '\0' + std::string(16, '\1');
  const std::string wide{"\xff\xff\x00\x00\xff\xff\x00\x00", 8};
  const std::string longText{"\xff\xff\xff\x7fxx", 6};
  const std::pair<const char*, std::string> values[] = {{"chlist", channel + channel},
                                                        {"box2i", std::string(12, '\0')},
                                                        {"preview", wide},
                                                        {"stringvector", longText}};
  for (const auto& [type, value] : values) {
    const std::string file =
        folder.write("a.exr", start + attribute("owner", type, uint32_t(value.size())) + value +
                                  attribute("big", "opaque", 0x60000000) + std::string(64, '\2'));
    for (const std::string& message : {messageOf<InputError>([&] { openImage(file); }),
                                       messageOf<InputError>([&] { FastExr::open(file); })})
      EXPECT_NE(message.find("attribute owner has"), std::string::npos) << type << ": " << message;
  }
}

TEST(HeaderClaims, LaterPartsAreLookedAtToo) {
  const TestFolder folder;
  std::string several = start;
  several[5] = '\x10';
  const std::string small = attribute("a", "int", 4) + std::string(4, 'x') + '\0';
  const std::string file =
      folder.write("a.exr", several + small + attribute("late", "string", 1u << 30));
  EXPECT_NE(messageOf<InputError>([&] { openImage(file); }).find("late"), std::string::npos);
}

TEST(HeaderClaims, WhatIsNoExrIsLeftToTheLibrary) {
  const TestFolder folder;
  for (const std::string& text :
       {std::string(), start, std::string("text"), start + "name", start + std::string(400, 'n')}) {
    const std::string file = folder.write("a.exr", text);
    checkHeaderClaims(file, text.size());
    EXPECT_THROW(openImage(file), InputError);
  }
}

/// A part's list of channels, and what ends its header.
std::string listOf(const std::vector<std::string>& channels) {
  std::string list;
  for (const std::string& channel : channels) list += channel + '\0' + std::string(16, '\1');
  list += '\0';
  return attribute("channels", "chlist", uint32_t(list.size())) + list;
}

// Found by changing a byte of a channel's name: the library sorted the list, every channel after it
// had another one's pixels, and the scrambled picture was taken for good.
TEST(HeaderClaims, ChannelsThatAreNotInTheOrderOfTheirNamesAreRefused) {
  const TestFolder folder;
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"A", "Z", "G"}, "it lists channel G after Z"},
      {{"a", "B"}, "it lists channel B after a"},
      {{"A", "A"}, "it lists channel A twice"}};
  for (const auto& [channels, said] : cases) {
    const std::string file = folder.write("a.exr", start + listOf(channels) + '\0');
    for (const std::string& message : {messageOf<InputError>([&] { openImage(file); }),
                                       messageOf<InputError>([&] { FastExr::open(file); })})
      EXPECT_NE(message.find("a.exr cannot be read as an EXR file: " + std::string(said)),
                std::string::npos)
          << message;
  }
  const std::string sorted = start + listOf({"A", "B.x", "B.y", "a", "b", "\xc3\xa4"}) + '\0';
  EXPECT_NO_THROW(checkHeaderClaims(folder.write("b.exr", sorted), sorted.size()));
}

TEST(HeaderClaims, ChannelsOutOfOrderAreCalledByTheirPart) {
  const TestFolder folder;
  std::string several = start;
  several[5] = '\x10';
  const std::string name = attribute("name", "string", 3) + "rgb";
  const std::string file =
      folder.write("a.exr", several + listOf({"A", "B"}) + '\0' + listOf({"B", "A"}) + name + '\0');
  EXPECT_NE(
      messageOf<InputError>([&] { openImage(file); }).find("its part 2 (rgb) lists channel A"),
      std::string::npos);
}

// Found by the same change in a whole file that both readers had read.
TEST(HeaderClaims, AWholeFileIsReadBySortedNamesOnly) {
  const TestFolder folder;
  Floats plane(8, 8);
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, 8, 8};
  for (const char* channel : {"Key.A", "Key.B", "Key.C"})
    image.channels.push_back(floatChannel(channel, PixelType::half, plane));
  writeExr(folder / "a.exr", image);
  std::string bytes = TestFolder::read(folder / "a.exr");
  bytes.replace(bytes.find("Key.B"), 5, "Key.D");
  const std::string file = folder.write("a.exr", bytes);
  EXPECT_NE(messageOf<InputError>([&] { openImage(file); }).find("channel Key.C after Key.D"),
            std::string::npos);
  EXPECT_THROW(FastExr::open(file), InputError);
}

std::string written(const TestFolder& folder, Compression compression) {
  Floats plane(64, 40);
  for (size_t i = 0; i < plane.view().pixels(); ++i) plane.row(0)[i] = static_cast<float>(i % 97);
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, 64, 40};
  image.compression = compression;
  image.channels.push_back(floatChannel("R", PixelType::half, plane));
  writeExr(folder / "a.exr", image);
  return folder / "a.exr";
}

TEST(HeaderClaims, AFileThatWasCutIsNotWhole) {
  const TestFolder folder;
  for (const Compression compression :
       {Compression::none, Compression::zips, Compression::zip, Compression::piz}) {
    const std::string file = written(folder, compression);
    EXPECT_TRUE(isWholeExr(file));
    const auto size = fs::file_size(file);
    for (const size_t cut : {size_t{1}, size_t{100}, size / 2}) {
      fs::resize_file(file, size - cut);
      EXPECT_FALSE(isWholeExr(file)) << cut;
      written(folder, compression);
    }
    fs::resize_file(file, 20);
    EXPECT_THROW(isWholeExr(file), InputError);
  }
}

}  // namespace
}  // namespace kagefude
