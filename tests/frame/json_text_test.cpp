#include "frame/json_text.h"

#include <gtest/gtest.h>

namespace kagefude::detail {
namespace {

TEST(JsonText, WithinBoundsIsFine) {
  EXPECT_EQ(beyondBounds(R"({"a": [1, 2, {"b": "[[[[[[[[[[\"[[[[[[,,,,,,,"}]})", {3, 6}), "");
  EXPECT_EQ(beyondBounds("]]]]}}}", {3, 10}), "");
}

TEST(JsonText, DepthAndNumberAreBound) {
  EXPECT_NE(beyondBounds("[[[[", {3, 100}).find("3 deep"), std::string::npos);
  EXPECT_NE(beyondBounds(R"({"a":{"b":{"c":{}}}})", {3, 100}).find("3 deep"), std::string::npos);
  EXPECT_NE(beyondBounds("[1,2,3,4]", {3, 4}).find("4 values"), std::string::npos);
  EXPECT_NE(beyondBounds(std::string(1 << 20, '[')), "");
}

}  // namespace
}  // namespace kagefude::detail
