#include "compositor/strip_set.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "exr/write_image.h"
#include "test_folder.h"

namespace kagefude {
namespace {

class KeptStrips : public ::testing::Test {
 protected:
  void writeStrip(const std::string& name, float grey) const {
    const Floats plane(8, 8, grey);
    writePng(folder_ / name, plane, plane, plane);
  }
  Look lookWith(const std::vector<std::string>& strips) const {
    std::string text;
    for (const std::string& strip : strips)
      text += "[[style]]\nobject = \"" + strip + "\"\nstrip = \"" + strip + "\"\n";
    return readLookText(text, folder_ / "look.toml", {});
  }
  static const Rgba* texelsOf(const StripSet& set, const std::string& name) {
    return set.strips()[static_cast<size_t>(set.indexOf(name))].pool.row(0);
  }

  TestFolder folder_;
  Colour colour_;
};

TEST_F(KeptStrips, GoOverAsTheyAreAndTheOthersAreLoaded) {
  writeStrip("a.png", 0.2f);
  writeStrip("b.png", 0.4f);
  writeStrip("c.png", 0.6f);
  StripSet first(lookWith({"a.png", "b.png"}), colour_);
  const Rgba* const a = texelsOf(first, "a.png");
  const Rgba* const neutral = texelsOf(first, "builtin:neutral");
  folder_.write("a.png", "no picture any more");
  StripSet::Loaded loaded = first.release();
  EXPECT_EQ(loaded.size(), 3u);
  const StripSet second(lookWith({"c.png", "a.png"}), colour_, loaded);
  EXPECT_EQ(loaded.size(), 1u);
  EXPECT_TRUE(loaded.contains("b.png"));
  EXPECT_EQ(texelsOf(second, "a.png"), a);
  EXPECT_EQ(texelsOf(second, "builtin:neutral"), neutral);
  const StripSet whole(lookWith({"c.png"}), colour_);
  EXPECT_EQ((*texelsOf(second, "c.png"))[0], (*texelsOf(whole, "c.png"))[0]);
}

TEST_F(KeptStrips, AnErrorLeavesThemWhereTheyWere) {
  writeStrip("a.png", 0.2f);
  StripSet first(lookWith({"a.png"}), colour_);
  const Rgba* const a = texelsOf(first, "a.png");
  StripSet::Loaded loaded = first.release();
  EXPECT_THROW(StripSet(lookWith({"a.png", "none.png"}), colour_, loaded), InputError);
  EXPECT_EQ(loaded.at("a.png").pool.row(0), a);
}

TEST_F(KeptStrips, AStripThatNobodyAskedForIsNotLoaded) {
  writeStrip("a.png", 0.2f);
  StripSet set(lookWith({"a.png"}), colour_);
  EXPECT_FALSE(set.release().contains("builtin:neutral"));
  EXPECT_TRUE(set.strips().empty());
}

TEST_F(KeptStrips, WhatIsNotThereIsLoadedAgain) {
  writeStrip("a.png", 0.2f);
  StripSet first(lookWith({"a.png"}), colour_);
  const float before = (*texelsOf(first, "a.png"))[0];
  writeStrip("a.png", 0.6f);
  StripSet::Loaded none;
  const StripSet second(lookWith({"a.png"}), colour_, none);
  EXPECT_GT((*texelsOf(second, "a.png"))[0], before);
}

}  // namespace
}  // namespace kagefude
