#include "live/strip_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "exr/write_image.h"
#include "live/strip_easel.h"
#include "passes/strip/strip_paint.h"
#include "picture/strip_file.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

class Store : public ::testing::Test {
 protected:
  Look look(const std::string& text = "") const {
    return readLookText(text, place_ / "look.toml", {});
  }
  /// A file's bytes, of a strip that runs from dark to bright and is fit to paint with.
  std::string picture(float brightest) const {
    Floats plane(16, 32);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 16; ++x) plane(x, y) = brightest * static_cast<float>(31 - y) / 31;
    writePng(folder_ / "strip.png", plane, plane, plane);
    return bytesOf(folder_ / "strip.png");
  }
  static std::string bytesOf(const fs::path& file) {
    std::ostringstream content;
    content << std::ifstream(file, std::ios::binary).rdbuf();
    return content.str();
  }
  size_t files() const {
    size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(place_))
      count += entry.is_regular_file() ? 1 : 0;
    return count;
  }

  TestFolder folder_;
  const fs::path place_ = [this] {  // the look's
    fs::create_directory(folder_ / "look");
    return folder_ / "look";
  }();
};

TEST_F(Store, ADroppedStripLiesBesideTheLook) {
  const std::string bytes = picture(1);
  const StripKept kept = keepStrip(look(), "teal.png", bytes, false);
  EXPECT_EQ(kept.strip, "strips/teal.png");
  EXPECT_EQ(bytesOf(place_ / "strips/teal.png"), bytes);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Store, ItLiesWhereTheLooksOtherStripsAre) {
  const Look painted = look(
      "[[style]]\nstrip = \"builtin:soft\"\nobject = \"A\"\n"
      "[[style]]\nstrip = \"out/painted/a.png\"\nobject = \"B\"\n");
  EXPECT_EQ(keepStrip(painted, "teal.png", picture(1), false).strip, "out/painted/teal.png");
  const Look plain = look("[[style]]\nstrip = \"a.png\"\n");
  EXPECT_EQ(keepStrip(plain, "teal.png", picture(1), false).strip, "teal.png");
  const Look foreign = look("[[style]]\nstrip = \"/elsewhere/a.png\"\n");
  EXPECT_EQ(stripsFolder(foreign), place_ / "strips");
}

TEST_F(Store, WhatIsThereIsNeverReplaced) {
  const std::string first = picture(1), second = picture(0.8f);
  keepStrip(look(), "teal.png", first, false);
  EXPECT_EQ(keepStrip(look(), "teal.png", first, false).strip, "strips/teal.png");
  for (const bool anyway : {false, true}) {
    const StripKept asked = keepStrip(look(), "teal.png", second, anyway);
    EXPECT_EQ(asked.strip, "");
    EXPECT_NE(asked.question.find("teal.png is there already"), std::string::npos);
    EXPECT_EQ(asked.freeName, "teal-2.png");
  }
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(keepStrip(look(), "teal-2.png", second, true).strip, "strips/teal-2.png");
  EXPECT_EQ(bytesOf(place_ / "strips/teal.png"), first);
  EXPECT_EQ(keepStrip(look(), "teal.png", picture(0.6f), true).freeName, "teal-3.png");
}

TEST_F(Store, WhatIsToMendIsAskedAbout) {
  const Floats upsideDown = [] {
    Floats plane(16, 32);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 16; ++x) plane(x, y) = static_cast<float>(y) / 31;
    return plane;
  }();
  writePng(folder_ / "x.png", upsideDown, upsideDown, upsideDown);
  const std::string bytes = bytesOf(folder_ / "x.png");
  const StripKept asked = keepStrip(look(), "x.png", bytes, false);
  EXPECT_EQ(asked.strip, "");
  EXPECT_TRUE(asked.question.starts_with("Keep x.png?\n")) << asked.question;
  EXPECT_EQ(asked.freeName, "x.png");
  EXPECT_FALSE(fs::exists(place_ / "strips"));
  EXPECT_EQ(keepStrip(look(), "x.png", bytes, true).strip, "strips/x.png");
}

TEST_F(Store, WhatIsNoStripLeavesNothing) {
  for (const std::string& bytes :
       {std::string(), std::string("no picture"), picture(1).substr(0, 60)})
    EXPECT_THROW(keepStrip(look(), "teal.png", bytes, true), InputError);
  EXPECT_TRUE(fs::is_empty(place_));
}

TEST_F(Store, ItIsCalledByItsOwnNameWhenItIsRefused) {
  try {
    keepStrip(look(), "teal.png", "no picture", false);
    ADD_FAILURE() << "was kept";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("teal.png ")) << error.what();
    EXPECT_EQ(std::string(error.what()).find("kagefude-"), std::string::npos) << error.what();
  }
}

TEST_F(Store, NamesThatLeadElsewhereAreRefused) {
  const std::string bytes = picture(1);
  for (const std::string name :
       {"", ".png", "..png", "../teal.png", "a/teal.png", "/tmp/teal.png", "a\\teal.png",
        "c:teal.png", "teal", "teal.toml", "look.toml", "teal.png.sh", "a\nb.png"})
    EXPECT_THROW(keepStrip(look(), name, bytes, true), LookError) << name;
  EXPECT_THROW(keepStrip(look(), std::string("a\0b.png", 7), bytes, true), LookError);
  EXPECT_THROW(keepStrip(look(), std::string(97, 'a') + ".png", bytes, true), LookError);
  EXPECT_TRUE(fs::is_empty(place_));
}

TEST_F(Store, ALinkOutOfTheFolderIsNotFollowed) {
  const fs::path away = folder_ / "away";
  fs::create_directory(away);
  fs::create_directory_symlink(away, place_ / "strips");
  EXPECT_THROW(keepStrip(look(), "teal.png", picture(1), true), LookError);
  fs::remove(place_ / "strips");
  fs::create_directory(place_ / "strips");
  fs::create_symlink(away / "teal.png", place_ / "strips/teal.png");
  EXPECT_EQ(keepStrip(look(), "teal.png", picture(1), true).freeName, "teal-2.png");
  EXPECT_TRUE(fs::is_empty(away));
}

TEST_F(Store, APaintedStripIsWhatStripMakeWrites) {
  const StripRecipe recipe{"soft", {"width=64", "height=32", "seed=5"}};
  EXPECT_EQ(keepPaintedStrip(look(), "mine.png", recipe).strip, "strips/mine.png");
  StripPaintParams params = stripPreset("soft");
  params.width = 64, params.height = 32, params.seed = 5;
  const PaintedStrip wanted = paintStrip(params);
  const StripPicture kept = readStrip(place_ / "strips/mine.png");
  ASSERT_EQ(kept.width(), 64);
  const ShownPixels shown = paintedStrip(recipe);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      ASSERT_NEAR(kept.red(x, y), wanted.r(x, y), 1e-5);
      const auto byte =
          static_cast<unsigned char>(shown.bytes[4u * static_cast<unsigned>(64 * y + x)]);
      ASSERT_NEAR(byte, 255 * wanted.r(x, y), 0.51);
    }
  EXPECT_EQ(keepPaintedStrip(look(), "mine.png", recipe).freeName, "mine-2.png");
}

TEST_F(Store, RecipesAreHeldToTheTable) {
  EXPECT_THROW(paintedStrip({"none", {}}), LookError);
  EXPECT_THROW(paintedStrip({"soft", {"sed=1"}}), LookError);
  EXPECT_THROW(paintedStrip({"soft", {"width=1"}}), LookError);
  EXPECT_THROW(paintedStrip({"soft", {"width=16384", "height=16384"}}), LookError);
  EXPECT_THROW(keepPaintedStrip(look(), "mine.tif", {}), UsageError);
  EXPECT_TRUE(fs::is_empty(place_));
}

}  // namespace
}  // namespace kagefude
