#include "live/page_paths.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

class PagePaths : public ::testing::Test {
 protected:
  std::string refusal(const std::vector<std::string>& set) const {
    const auto file = folder / "look.toml";
    try {
      refuseForeignPaths(readLook(file, {}), readLook(file, set));
    } catch (const LookError& error) {
      return error.what();
    }
    return "";
  }

  void write(const std::string& text) { folder.write("look.toml", text); }

  TestFolder folder;
};

TEST_F(PagePaths, LetStripsOfTheFolderThrough) {
  write("[[style]]\nstrip = \"/elsewhere/strip.png\"\n");
  folder.write("strips/a.png", "");
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({"style[0].strip=strips/a.png"}), "");
  EXPECT_EQ(refusal({"style[0].strip=not-there-yet.png"}), "");
  EXPECT_EQ(refusal({"style[0].strip=builtin:cel"}), "");
  EXPECT_EQ(refusal({"brush.contrast=0.5"}), "");
}

TEST_F(PagePaths, RefuseStripsElsewhere) {
  write("[[style]]\nstrip = \"builtin:soft\"\n");
  std::filesystem::create_directory_symlink("/", folder / "out");
  for (const char* strip : {"/etc/passwd", "../strip.png", "a/../../strip.png", "out/etc/passwd"})
    EXPECT_NE(refusal({std::string("style[0].strip=") + strip}).find(strip), std::string::npos)
        << strip;
}

TEST_F(PagePaths, RefuseStripsOfLightsElsewhere) {
  write("[[light]]\nname = \"Rim\"\n[[style]]\nlight_strips = [\"Key=/mine/key.png\"]\n");
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({"light[0].strip=strips/rim.png"}), "");
  EXPECT_EQ(refusal({"style[0].light_strips=[\"Rim=builtin:cel\", \"Key=\"]"}), "");
  EXPECT_NE(refusal({"light[0].strip=/etc/passwd"}).find("light.strip"), std::string::npos);
  EXPECT_NE(refusal({"style[0].light_strips=[\"Rim=../rim.png\"]"}).find("style.light_strips"),
            std::string::npos);
}

TEST_F(PagePaths, RefuseEveryOtherFileThatTheLookDoesNotName) {
  write("colour.config = \"own.ocio\"\n[[light]]\nname = \"Key\"\n[[style]]\n");
  EXPECT_EQ(refusal({"colour.config=own.ocio"}), "");
  for (const char* set :
       {"colour.config=/etc/passwd", "shadow.blob=blob.png", "light[0].shadow.blob=blob.png",
        "light[0].depth_map=depth.exr", "frame.files=[\"other.####.exr\"]"})
    EXPECT_NE(refusal({set}).find("cannot be set from the page"), std::string::npos) << set;
}

}  // namespace
}  // namespace kagefude
