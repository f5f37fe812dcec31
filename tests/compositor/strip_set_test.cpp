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
  const StripSet second(lookWith({"c.png", "a.png"}), colour_, first, {"a.png", "builtin:neutral"});
  EXPECT_EQ(texelsOf(second, "a.png"), a);
  EXPECT_EQ(texelsOf(second, "builtin:neutral"), neutral);
  const StripSet whole(lookWith({"c.png"}), colour_);
  EXPECT_EQ((*texelsOf(second, "c.png"))[0], (*texelsOf(whole, "c.png"))[0]);
}

TEST_F(KeptStrips, AnErrorLeavesThemWhereTheyWere) {
  writeStrip("a.png", 0.2f);
  StripSet first(lookWith({"a.png"}), colour_);
  const Rgba* const a = texelsOf(first, "a.png");
  EXPECT_THROW(StripSet(lookWith({"a.png", "none.png"}), colour_, first, {"a.png"}), InputError);
  EXPECT_EQ(texelsOf(first, "a.png"), a);
  EXPECT_FALSE(first.strips()[static_cast<size_t>(first.indexOf("a.png"))].levels.empty());
}

TEST_F(KeptStrips, WhatIsNotNamedIsLoadedAgain) {
  writeStrip("a.png", 0.2f);
  StripSet first(lookWith({"a.png"}), colour_);
  const float before = (*texelsOf(first, "a.png"))[0];
  writeStrip("a.png", 0.6f);
  const StripSet second(lookWith({"a.png"}), colour_, first, {});
  EXPECT_GT((*texelsOf(second, "a.png"))[0], before);
}

}  // namespace
}  // namespace kagefude
