#include "base/frame_pattern.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

std::string at(const char* pattern, int frame, const char* view = "") {
  return FramePattern(pattern).path(frame, view).string();
}

TEST(FramePattern, FillsEveryForm) {
  EXPECT_EQ(at("d/shot.####.exr", 7), "d/shot.0007.exr");
  EXPECT_EQ(at("shot.#.exr", 7), "shot.0007.exr");
  EXPECT_EQ(at("shot.##.exr", 7), "shot.07.exr");
  EXPECT_EQ(at("shot.######.exr", 7), "shot.000007.exr");
  EXPECT_EQ(at("shot.@@@.exr", 7), "shot.007.exr");
  EXPECT_EQ(at("shot.%04d.exr", 7), "shot.0007.exr");
  EXPECT_EQ(at("shot.%d.exr", 7), "shot.7.exr");
  EXPECT_EQ(at("shot.$F4.exr", 7), "shot.0007.exr");
  EXPECT_EQ(at("shot.$F.exr", 7), "shot.7.exr");
  EXPECT_EQ(at("shot####", 7), "shot0007");
}

TEST(FramePattern, WideAndNegativeNumbers) {
  EXPECT_EQ(at("shot.####.exr", 123456), "shot.123456.exr");
  EXPECT_EQ(at("shot.####.exr", -5), "shot.-005.exr");
  EXPECT_EQ(at("shot.%d.exr", -5), "shot.-5.exr");
}

TEST(FramePattern, NamesWithoutAPlace) {
  for (const char* name : {"shot.exr", "img@2x.exr", "50%.exr", "price$Final.exr", "shot.0012.exr",
                           "ep####/shot.exr", "%05x.exr"}) {
    EXPECT_FALSE(FramePattern(name).hasFrame()) << name;
    EXPECT_EQ(at(name, 7), name);
  }
}

TEST(FramePattern, FillsViews) {
  EXPECT_EQ(at("%V/shot_%v.####.exr", 7, "left"), "left/shot_l.0007.exr");
  EXPECT_EQ(at("shot.####.%V.exr", 7, "right"), "shot.0007.right.exr");
  EXPECT_TRUE(FramePattern("shot_%v.exr").hasView());
  EXPECT_THROW(at("shot.%V.exr", 7), UsageError);
}

TEST(FramePattern, RefusesImpossiblePatterns) {
  for (const char* text : {"", "folder/", "a.####.b.####.exr", "a.##.%04d.exr", "a.%4d.exr",
                           "a.%099d.exr", "a.%00d.exr", "a.$F0.exr"})
    EXPECT_THROW(FramePattern{text}, UsageError) << text;
  EXPECT_THROW(FramePattern(std::string(40, '#')), UsageError);
}

TEST(FramePattern, ScansWhatThePaddingAllows) {
  const TestFolder folder;
  for (const char* name : {"shot.0001.exr", "shot.0012.exr", "shot.12345.exr", "shot.-005.exr",
                           "shot.-0007.exr", "shot.12.exr", "shot.00013.exr", "shot.0001.png",
                           "shot.abcd.exr", "shot..exr", "shot.0002.exr.tmp", ".shot.0003.exr",
                           "shot.-0.exr", "shot.-0000.exr", "shot.99999999999.exr"})
    folder.write(name);
  std::filesystem::create_directory(folder / "shot.0004.exr");

  const auto files = FramePattern(folder / "shot.####.exr").scan();
  std::vector<int> frames;
  for (const auto& [frame, path] : files) frames.push_back(frame);
  EXPECT_EQ(frames, (std::vector<int>{-7, -5, 1, 12, 12345}));
  EXPECT_EQ(files.at(-7).string(), folder / "shot.-0007.exr");
}

TEST(FramePattern, PrefersItsOwnSpellingOfANegativeFrame) {
  const TestFolder folder;
  folder.write("s.-005.exr");
  folder.write("s.-0005.exr");
  const auto files = FramePattern(folder / "s.####.exr").scan();
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files.at(-5).filename(), "s.-005.exr");
}

TEST(FramePattern, UnpaddedScanTakesNoLeadingZeros) {
  const TestFolder folder;
  for (const char* name : {"s.1.exr", "s.10.exr", "s.02.exr", "s.0.exr"}) folder.write(name);
  EXPECT_EQ(FramePattern(folder / "s.%d.exr").scan().size(), 3u);
}

TEST(FramePattern, ScansViewsAndMissingFolders) {
  const TestFolder folder;
  folder.write("left/s.0001.exr");
  const FramePattern pattern(folder / "%V/s.####.exr");
  EXPECT_EQ(pattern.scan("left").size(), 1u);
  EXPECT_TRUE(pattern.scan("right").empty());
  EXPECT_TRUE(FramePattern(folder / "none/s.####.exr").scan().empty());
}

TEST(FrameNumberOf, ReadsTheNumberAtTheEnd) {
  EXPECT_EQ(frameNumberOf("d/shot.0012.exr"), 12);
  EXPECT_EQ(frameNumberOf("shot0012.exr"), 12);
  EXPECT_EQ(frameNumberOf("shot.-003.exr"), -3);
  EXPECT_EQ(frameNumberOf("shot-003.exr"), 3);
  EXPECT_EQ(frameNumberOf("shot.exr"), std::nullopt);
  EXPECT_EQ(frameNumberOf("12a.exr"), std::nullopt);
  EXPECT_EQ(frameNumberOf("s.99999999999999.exr"), std::nullopt);
}

}  // namespace
}  // namespace kagefude
