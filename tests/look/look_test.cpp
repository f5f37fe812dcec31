#include "look/look.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace kagefude {
namespace {

class LookFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("kagefude_look_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Look read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    std::ofstream(folder_ / "a.toml") << text;
    return readLook(folder_ / "a.toml", overrides);
  }
  std::string errorOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      read(text, overrides);
    } catch (const LookError& error) {
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return "no error";
  }
  std::string setErrorOf(const std::string& text) {
    try {
      read("[[style]]\n", {text});
    } catch (const LookError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(LookFile, AnEmptyLookGivesTheDefaults) {
  const Look look = read("");
  EXPECT_EQ(look.passes.pair.search, PairParams{}.search);
  EXPECT_TRUE(look.lights.empty());
  EXPECT_TRUE(look.styles.empty());
}

TEST_F(LookFile, SectionsLightsAndStylesInherit) {
  const Look look = read(R"(
[smooth]
h = 3
[[light]]
name = "Key"
smooth.h = 5
[[style]]
object = ["Vase*", "Jug"]
strip = "a.png"
)");
  EXPECT_EQ(look.passes.smooth.h, 3);
  EXPECT_EQ(look.lights.at(0).passes.smooth.h, 5);
  EXPECT_EQ(look.styles.at(0).passes.smooth.h, 3);
  EXPECT_EQ(look.styles.at(0).style.object.size(), 2u);
  EXPECT_EQ(look.resolve("a.png"), folder_ / "a.png");
}

TEST_F(LookFile, OverridesReachSectionsAndListElements) {
  const Look look = read("[[style]]\nobject = \"A\"\n",
                         {"smooth.h=4", "style[0].strip=b.png", "shadow.lights=[\"Key\"]"});
  EXPECT_EQ(look.passes.smooth.h, 4);
  EXPECT_EQ(look.styles[0].style.strip, "b.png");
  EXPECT_EQ(look.styles[0].passes.smooth.h, 4) << "overrides come before inheritance";
  EXPECT_EQ(look.shadow.lights, std::vector<std::string>{"Key"});
}

TEST_F(LookFile, ErrorsNameFileLineAndTheNearestKey) {
  EXPECT_EQ(errorOf("\n[smoth]\nh = 1\n"),
            "a.toml:2: the look has no key smoth (did you mean smooth?)");
  EXPECT_EQ(errorOf("[pair]\nserch = \"grid\"\n"),
            "a.toml:2: [pair] has no key serch (did you mean search?)");
  EXPECT_EQ(errorOf("[pair]\nsearch = \"grit\"\n"),
            "a.toml:2: pair.search cannot be \"grit\" (did you mean grid?); it is one of exact and "
            "grid");
  EXPECT_EQ(errorOf("[smooth]\nh = 1.5\n").substr(0, 39),
            "a.toml:2: smooth.h wants a whole number");
  EXPECT_NE(errorOf("[smooth]\nh = 99999\n").find("outside its range"), std::string::npos);
  EXPECT_NE(errorOf("[smooth]\nh = nan\n").find("outside its range"), std::string::npos);
  EXPECT_NE(errorOf("[smooth\n").find("a.toml:1"), std::string::npos);
  EXPECT_NE(errorOf("[[light]]\nradius = 1\n").find("wants a name"), std::string::npos);
  EXPECT_NE(errorOf("kagefude = 9\n").find("version"), std::string::npos);
  EXPECT_NE(errorOf("style = 3\n").find("list of sections"), std::string::npos);
}

TEST_F(LookFile, BadOverridesAreNamed) {
  EXPECT_EQ(setErrorOf("smooth"), "--set smooth: expected section.key=value");
  EXPECT_EQ(setErrorOf("smooth=1"), "--set smooth=1: expected section.key=value");
  EXPECT_EQ(setErrorOf("style[3].strip=a"), "--set style[3].strip=a: the look has no style[3]");
  EXPECT_NE(setErrorOf("smooth.g=1").find("--set"), std::string::npos);
  EXPECT_NE(setErrorOf("style[x].strip=a").find("whole number"), std::string::npos);
}

TEST_F(LookFile, AMissingFileIsNamed) {
  EXPECT_THROW(readLook(folder_ / "none.toml", {}), LookError);
}

TEST_F(LookFile, ResolvedTextReadsBackToItself) {
  const Look look = read(
      "[[light]]\nname=\"K\\\"ey\"\nposition=[1,2,3.5]\n[smooth]\nh=7\n"
      "[[style]]\nobject=[\"A\",\"B\"]\n");
  const std::string text = resolvedText(look);
  EXPECT_EQ(resolvedText(read(text)), text);
}

TEST(LookSections, NamesAreUniqueAndDefaultsLieInTheirRanges) {
  std::vector<std::string_view> names;
  for (const LookSection& section : lookSections) {
    const ParameterTable* table = section.table;
    EXPECT_EQ(std::count(names.begin(), names.end(), table->pass), 0) << table->pass;
    names.push_back(table->pass);
    for (const Parameter& p : table->parameters) {
      EXPECT_FALSE(p.help.empty()) << table->pass << "." << p.name;
      const Value value = p.defaultValue();
      double number = 0;
      if (const int* i = std::get_if<int>(&value); i && p.type == ValueType::integer) number = *i;
      if (const double* d = std::get_if<double>(&value)) number = *d;
      if (p.minimum < p.maximum && p.type != ValueType::numbers) {
        EXPECT_GE(number, p.minimum) << table->pass << "." << p.name;
        EXPECT_LE(number, p.maximum) << table->pass << "." << p.name;
      }
    }
  }
}

TEST_F(LookFile, HighestPriorityHoldsThenTheFirst) {
  const Look look = read(
      "[[style]]\nobject=\"*\"\nstrip=\"a\"\n[[style]]\nobject=\"*\"\nstrip=\"b\"\n"
      "priority=2\n[[style]]\nobject=\"*\"\nstrip=\"c\"\npriority=2\n");
  const auto all = [](const StyleParams&) { return true; };
  EXPECT_EQ(chooseStyle(look.styles, all)->style.strip, "b");
  const auto notB = [](const StyleParams& style) { return style.strip != "b"; };
  EXPECT_EQ(chooseStyle(look.styles, notB)->style.strip, "c");
  const auto onlyA = [](const StyleParams& style) { return style.strip == "a"; };
  EXPECT_EQ(chooseStyle(look.styles, onlyA)->style.strip, "a");
  EXPECT_EQ(chooseStyle(look.styles, [](const StyleParams&) { return false; }), nullptr);
}

TEST_F(LookFile, TwoLightsOfOneNameAreRefused) {
  const std::string text = "[[light]]\nname = \"Key\"\n\n[[light]]\nname = \"Key\"\n";
  EXPECT_EQ(errorOf(text), "a.toml:4: there are two [[light]] named Key");
}

TEST_F(LookFile, WhatIsNoFileIsNoLook) {
  EXPECT_THROW(readLook(folder_, {}), LookError);
  EXPECT_THROW(readLook("/dev/zero", {}), LookError);
  EXPECT_THROW(readLook(folder_ / "none.toml", {}), LookError);
  EXPECT_TRUE(readLook("/dev/null", {}).styles.empty()) << "what nothing is called";
}

}  // namespace
}  // namespace kagefude
