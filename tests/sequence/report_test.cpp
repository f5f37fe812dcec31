#include "sequence/report.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "sequence/report_page.h"
#include "test_folder.h"

namespace kagefude {
namespace {

Thumbnail plain(int width, int height, uint8_t value) {
  return {width, height, std::vector<uint8_t>(size_t(3) * width * height, value)};
}

/// Counts pictures instead of writing PNGs.
struct Writer {
  std::vector<std::string> names;
  Report::WriteImage get() {
    return [this](const std::filesystem::path& path, const Thumbnail&) {
      names.push_back(path.filename().string());
    };
  }
};

TEST(FrameChange, MeanAndLargestBlock) {
  const Thumbnail before = plain(32, 16, 10);
  Thumbnail after = plain(32, 16, 10);
  EXPECT_EQ(frameChange(before, after).mean, 0);
  for (int y = 8; y < 16; ++y)
    for (int x = 8; x < 16; ++x)
      for (int c = 0; c < 3; ++c) after.rgb[3 * (y * 32 + x) + c] = 90;
  EXPECT_DOUBLE_EQ(frameChange(before, after).mean, 80.0 / 8);  // one of eight blocks
  EXPECT_DOUBLE_EQ(frameChange(before, after).largest, 80);
}

TEST(FrameChange, EdgesBlocksAndSizes) {
  EXPECT_DOUBLE_EQ(frameChange(plain(9, 9, 0), plain(9, 9, 7)).largest, 7);
  EXPECT_DOUBLE_EQ(frameChange(plain(9, 9, 0), plain(9, 8, 0)).mean, 255);
  EXPECT_EQ(frameChange({}, {}).mean, 0);
}

TEST(FindPops, SeesOneJumpAmongSteadyMotion) {
  std::vector<double> changes(20, 4.0);
  EXPECT_TRUE(findPops(changes).empty());
  changes[0] = -1;
  changes[12] = 30;
  EXPECT_EQ(findPops(changes), (std::vector<size_t>{12}));
  EXPECT_TRUE(findPops({}).empty());
  EXPECT_TRUE(findPops({-1}).empty());
  EXPECT_TRUE(findPops({-1, 50}).empty());
}

TEST(FindPops, SlowGrowthIsNoJump) {
  std::vector<double> changes;
  for (int i = 0; i < 30; ++i) changes.push_back(i * 2.0);
  EXPECT_TRUE(findPops(changes).empty());
}

TEST(ReportPage, EscapesEverything) {
  EXPECT_EQ(escapeHtml("<a href=\"x\">&'\x01"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;\\x01");
  const TestFolder folder;
  Writer writer;
  const std::string nasty = "</pre><script>alert(1)</script>";
  Report report(folder.path(), {nasty, nasty, nasty, nasty}, writer.get());
  ReportFrame frame;
  frame.frame = 1;
  frame.view = nasty;
  frame.failure = nasty;
  frame.warnings = {nasty};
  report.add(frame, plain(4, 4, 1));
  report.finish();
  const std::string page = TestFolder::read(folder / "index.html");
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
  EXPECT_EQ(writer.names[0].find('/'), std::string::npos);
}

TEST(ReportPage, NeedsNoNetwork) {
  const TestFolder folder;
  Writer writer;
  Report report(folder.path(), {"t", "c", "v", "l"}, writer.get());
  for (int i = 1; i <= 3; ++i) {
    ReportFrame frame;
    frame.frame = i;
    report.add(frame, plain(4, 4, static_cast<uint8_t>(i)));
  }
  report.finish();
  const std::string page = TestFolder::read(folder / "index.html");
  EXPECT_EQ(page.find("//"), std::string::npos) << "no address of another host";
  EXPECT_NE(page.find("thumbs/0003.png"), std::string::npos);
}

TEST(Report, TakesFramesInAnyOrderAndShowsFailures) {
  const TestFolder folder;
  Writer writer;
  Report report(folder.path(), {"t", "c", "v", "l"}, writer.get());
  for (const int i : {3, 1, 2}) {
    ReportFrame frame;
    frame.frame = i;
    if (i == 2) frame.failure = "no Position pass";
    report.add(frame, i == 2 ? Thumbnail{} : plain(300, 200, 5));
  }
  report.finish();
  EXPECT_EQ(writer.names.size(), 2u);
  const std::string page = TestFolder::read(folder / "index.html");
  const size_t first = page.find("id=\"f0_1\"");
  const size_t second = page.find("id=\"f0_2\"");
  EXPECT_LT(first, second);
  EXPECT_LT(second, page.find("id=\"f0_3\""));
  EXPECT_NE(page.find("no Position pass"), std::string::npos);
}

TEST(Report, EmptyRunAndImpossibleFolder) {
  const TestFolder folder;
  Writer writer;
  Report(folder / "r", {"t", "c", "v", "l"}, writer.get()).finish();
  EXPECT_FALSE(TestFolder::read(folder / "r/index.html").empty());
  folder.write("file");
  EXPECT_THROW(Report(folder / "file", {}, writer.get()), OutputError);
}

}  // namespace
}  // namespace kagefude
