#include "live/strip_choice.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "compositor/sweep_frame.h"
#include "live/live_page.h"

namespace kagefude {
namespace {

class StripChoice : public ::testing::Test, protected testing::SweepFrame {};

TEST_F(StripChoice, PicturesOfTheFolderAndTheBuiltInOnes) {
  const TestFolder folder;
  for (const char* name : {"b.png", "a.TIF", "deep/er/c.jpg", "deep/er/still/d.webp",
                           "1/2/3/4/too_deep.png", ".hidden/e.png", ".f.png", "frame.exr", "x.txt"})
    folder.write(name);
  std::filesystem::create_symlink("b.png", folder / "link.png");
  std::filesystem::create_directory_symlink("deep", folder / "linked");
  const std::vector<std::string> expected{
      "builtin:neutral", "builtin:soft", "builtin:fine",  "builtin:cel",
      "a.TIF",           "b.png",        "deep/er/c.jpg", "deep/er/still/d.webp"};
  EXPECT_EQ(stripsToChoose(folder.path()), expected);
  EXPECT_EQ(stripsToChoose(folder.path() / "none").size(), 4u);
}

TEST_F(StripChoice, AStripIsShownSmallAndOnlyWhereThePageMayLook) {
  frame.folder.write("look.toml", "");
  blobFile();  // a grey picture of 8 x 8
  LiveFrame live(frame.write(), 1);
  StripShelf shelf;
  const Look onDisk = readLook(frame.folder / "look.toml", {});
  const LivePicture picture = live.compose(onDisk, shelf, 0);
  const ShownPixels soft = showStrip(picture, onDisk, "builtin:soft");
  EXPECT_LE(soft.height, 64);
  EXPECT_GT(soft.height, 16);
  EXPECT_EQ(soft.bytes.size(), static_cast<size_t>(4 * soft.width * soft.height));
  // The brightest row is the upper one.
  EXPECT_GT(static_cast<unsigned char>(soft.bytes[0]),
            static_cast<unsigned char>(soft.bytes[soft.bytes.size() - 4]));
  const ShownPixels blob = showStrip(picture, onDisk, "blob.png");
  EXPECT_EQ(blob.width, 8);
  EXPECT_NEAR(static_cast<unsigned char>(blob.bytes[0]), 0.3 * 255, 1);
  EXPECT_THROW(showStrip(picture, onDisk, "/etc/passwd"), LookError);
  EXPECT_THROW(showStrip(picture, onDisk, "../blob.png"), LookError);
  EXPECT_THROW(showStrip(picture, onDisk, "none.png"), InputError);
  EXPECT_THROW(showStrip(picture, onDisk, "builtin:none"), LookError);
}

}  // namespace
}  // namespace kagefude
