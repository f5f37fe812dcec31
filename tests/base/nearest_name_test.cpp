#include "base/nearest_name.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

TEST(NearestName, FindsTypingSlips) {
  const std::vector<std::string> names = {"Position", "Normal", "Depth"};
  EXPECT_EQ(nearestName("Postion", names), "Position");
  EXPECT_EQ(nearestName("Nomral", names), "Normal");
  EXPECT_EQ(nearestName("depth", names), "Depth");
}

TEST(NearestName, SaysNothingWhenNothingIsNear) {
  EXPECT_FALSE(nearestName("Cryptomatte", {"Depth", "UV"}));
  EXPECT_FALSE(nearestName("x", {}));
  EXPECT_EQ(didYouMean("Cryptomatte", {"Depth"}), "");
}

// A missing "camera" was taken for "layers", and any letter for any other.
TEST(NearestName, SaysNothingWhenAThirdIsOther) {
  EXPECT_EQ(didYouMean("camera", {"layers", "lights"}), "");
  EXPECT_EQ(didYouMean("R", {"B", "Z"}), "");
  EXPECT_EQ(didYouMean("", {"B"}), "");
  EXPECT_EQ(nearestName("r", {"B", "R"}), "R");
  EXPECT_EQ(nearestName("Rm", {"Rim"}), "Rim");
  EXPECT_EQ(nearestName("cemara", {"camera"}), "camera");
}

TEST(NearestName, ListsNames) {
  EXPECT_EQ(listNames({}), "none");
  EXPECT_EQ(listNames({"a"}), "a");
  EXPECT_EQ(listNames({"a", "b", "c"}), "a, b and c");
  EXPECT_EQ(listNames({"a", "b", "c"}, 2), "a, b and 1 more");
}

}  // namespace
}  // namespace kagefude
