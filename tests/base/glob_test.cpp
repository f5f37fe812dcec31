#include "base/glob.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

TEST(Glob, StarsAndQuestionMarks) {
  EXPECT_TRUE(matchesGlob("Vase", "Vase"));
  EXPECT_TRUE(matchesGlob("Vase.001", "Vase*"));
  EXPECT_TRUE(matchesGlob("Vase.001", "*.0?1"));
  EXPECT_TRUE(matchesGlob("", "*"));
  EXPECT_TRUE(matchesGlob("abcabd", "*ab?"));
  EXPECT_FALSE(matchesGlob("Vase", "vase"));
  EXPECT_FALSE(matchesGlob("Vase", "Vas"));
  EXPECT_FALSE(matchesGlob("", "?"));
  EXPECT_FALSE(matchesGlob("abc", "*b"));
}

TEST(Glob, ManyStarsStayCheap) {
  const std::string name(2000, 'a');
  std::string glob;
  for (int i = 0; i < 200; ++i) glob += "*a";
  EXPECT_FALSE(matchesGlob(name + "b", glob + "c"));
  EXPECT_TRUE(matchesGlob(name, glob));
}

TEST(Glob, AnyOfAList) {
  EXPECT_TRUE(matchesAny("Key", {"Fill", "K*"}));
  EXPECT_FALSE(matchesAny("Key", {}));
}

}  // namespace
}  // namespace kagefude
