#include "base/printed_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/printable.h"

namespace kagefude {
namespace {

TEST(PrintedJson, StaysJsonWhateverANameHolds) {
  const std::string name = "a\nb\x1b[31m\x7f\u009b\u200e\u2028\u5f71";
  const std::string text = printedJson({{"name", name}});
  for (const char c : text) EXPECT_TRUE((c >= ' ' && c < 0x7f) || c == '\n') << text;
  EXPECT_EQ(printableLines(text), text);
  EXPECT_EQ(nlohmann::json::parse(text)["name"], name);
}

TEST(PrintedJson, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(nlohmann::json::parse(printedJson({{"name", "a\xff"}}))["name"], "a\ufffd");
}

}  // namespace
}  // namespace kagefude
