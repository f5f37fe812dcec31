#include "look/write_look.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "look/look.h"
#include "test_folder.h"

namespace kagefude {
namespace {

std::string written(const std::string& text, const std::vector<std::string>& overrides) {
  return writeOverrides(text, "a.toml", overrides).text;
}

std::string refusal(const std::string& text, const std::vector<std::string>& overrides) {
  try {
    return "wrote " + written(text, overrides);
  } catch (const LookError& error) {
    return error.what();
  }
}

TEST(WriteLook, AValueIsReplacedInPlace) {
  EXPECT_EQ(written("# the look\nkagefude = 1\n\n[tone]\n gamma=  2.0   # softer\nwhite = 0.9\n",
                    {"tone.gamma=1.5"}),
            "# the look\nkagefude = 1\n\n[tone]\n gamma=  1.5   # softer\nwhite = 0.9\n");
  EXPECT_EQ(
      written("[[style]]\nobject = [ \"Vase\", # blue\n  \"Jar\" ] # both\nstrip = \"a.png\"\n",
              {"style[0].object=\"Vase\""}),
      "[[style]]\nobject = [\"Vase\"] # both\nstrip = \"a.png\"\n");
}

TEST(WriteLook, AValueThatNoTomlCanHaveIsRefusedInWords) {
  // Bytes that are no UTF-8, and another override that is written after them.
  EXPECT_EQ(
      refusal("[[style]]\nobject = \"Vase\"\n", {"style[0].object=[\"T\xbf\"]", "tone.gamma=2"}),
      "a.toml cannot be saved: its text cannot be changed so; write the values by hand");
}

TEST(WriteLook, WhatMeansTheSameIsNotTouched) {
  for (const std::string text :
       {"[tone]\ngamma = 1.50\n", "[tone]\ngamma = 15e-1 # so\n", "tone = { gamma = 1.5 }"})
    EXPECT_EQ(written(text, {"tone.gamma=1.5"}), text);
  EXPECT_EQ(written("[[style]]\nobject = 'Vase'\n", {"style[0].object=[\"Vase\"]"}),
            "[[style]]\nobject = 'Vase'\n");
  EXPECT_EQ(written("# nothing else\n", {}), "# nothing else\n");
}

TEST(WriteLook, ANewKeyGoesBelowTheLastOfItsSection) {
  EXPECT_EQ(written("[tone]\n  black = 0.1 # dark\n# end of tone\n\n[smooth]\nh = 3\n",
                    {"tone.gamma=1.5"}),
            "[tone]\n  black = 0.1 # dark\n  gamma = 1.5\n# end of tone\n\n[smooth]\nh = 3\n");
  EXPECT_EQ(written("[tone] # none yet\n[smooth]\n", {"tone.gamma=1.5"}),
            "[tone] # none yet\ngamma = 1.5\n[smooth]\n");
  EXPECT_EQ(written("[tone]\nblack = 0.1", {"tone.gamma=1.5"}),
            "[tone]\nblack = 0.1\ngamma = 1.5\n");
  EXPECT_EQ(written("tone.black = 0.1\n[smooth]\n", {"tone.gamma=1.5"}),
            "tone.black = 0.1\ntone.gamma = 1.5\n[smooth]\n");
  EXPECT_EQ(written("tone = { black = 0.1 } # short\n", {"tone.gamma=1.5"}),
            "tone = { black = 0.1, gamma = 1.5 } # short\n");
  EXPECT_EQ(written("tone = {}\n", {"tone.gamma=1.5"}), "tone = { gamma = 1.5 }\n");
}

TEST(WriteLook, ANewSectionGoesToTheEnd) {
  EXPECT_EQ(written("", {"tone.gamma=1.5"}), "[tone]\ngamma = 1.5\n");
  EXPECT_EQ(written("[[style]]\nstrip = \"a.png\"", {"tone.gamma=1.5", "tone.black=0.25"}),
            "[[style]]\nstrip = \"a.png\"\n\n[tone]\ngamma = 1.5\nblack = 0.25\n");
}

TEST(WriteLook, AnEntryTakesItsOwnKeys) {
  const std::string text =
      "[[style]] # one\nobject = \"Vase\"\nbrush.contrast = 0.5\n[style.tone]\nblack = 0.1\n\n"
      "[[style]] # two\nobject = \"Jar\"\n";
  EXPECT_EQ(
      written(text, {"style[0].brush.filter=bilinear", "style[0].tone.gamma=2",
                     "style[1].brush.contrast=0.25", "style[1].priority=3"}),
      "[[style]] # one\nobject = \"Vase\"\nbrush.contrast = 0.5\nbrush.filter = \"bilinear\"\n"
      "[style.tone]\nblack = 0.1\ngamma = 2\n\n"
      "[[style]] # two\nobject = \"Jar\"\nbrush.contrast = 0.25\npriority = 3\n");
  EXPECT_EQ(written("style = [{ object = \"Vase\" }]\n", {"style[0].brush.contrast=0.5"}),
            "style = [{ object = \"Vase\", brush.contrast = 0.5 }]\n");
  EXPECT_EQ(written("[style]\nobject = \"Vase\"\n", {"style[0].brush.contrast=0.5"}),
            "[style]\nobject = \"Vase\"\nbrush.contrast = 0.5\n");
  EXPECT_EQ(written("[style.tone]\nblack = 0.1\n", {"style[0].object=[\"Vase\"]"}),
            "[style.tone]\nblack = 0.1\n\n[style]\nobject = [\"Vase\"]\n");
}

TEST(WriteLook, ANewEntryIsBegunByItsName) {
  EXPECT_EQ(written("kagefude = 1\n", {"style[0].object=[\"Vase\"]", "style[0].brush.contrast=0.5",
                                       "light[0].name=\"Key\"", "light[0].shadow.strength=0.5"}),
            "kagefude = 1\n\n[[style]]\nobject = [\"Vase\"]\nbrush.contrast = 0.5\n\n"
            "[[light]]\nname = \"Key\"\nshadow.strength = 0.5\n");
  EXPECT_EQ(refusal("", {"style[1].object=\"Vase\""}),
            "--set style[1].object=\"Vase\": the look has no style[1]");
  EXPECT_EQ(refusal("", {"style[0].strip=\"a.png\""}),
            "--set style[0].strip=\"a.png\": the look has no style[0]");
}

TEST(WriteLook, LineEndsMarksAndLettersStay) {
  EXPECT_EQ(written("\xef\xbb\xbf# é\r\n[tone] # 影\r\nblack = 0.1 # 筆\r\n",
                    {"tone.black=0.25", "tone.gamma=1.5", "smooth.h=3"}),
            "\xef\xbb\xbf# é\r\n[tone] # 影\r\nblack = 0.25 # 筆\r\ngamma = 1.5\r\n\r\n"
            "[smooth]\r\nh = 3\r\n");
  EXPECT_EQ(written("[[style]]\nobject = \"影筆\" # é\n", {"style[0].object=\"筆\\n影\""}),
            "[[style]]\nobject = [\"筆\\u000a影\"] # é\n");
}

TEST(WriteLook, AValueBringsNothingElseWithIt) {
  EXPECT_EQ(written("", {"tone.gamma=1.5 # remark"}), "[tone]\ngamma = 1.5\n");
  EXPECT_NE(refusal("", {"tone.gamma=1.5\n[smooth]\nh = 3"}).find("more than one value"),
            std::string::npos);
  EXPECT_EQ(written("", {"style[0].object=Vase\"]\n[smooth]"}),
            "[[style]]\nobject = [\"Vase\\\"]\\u000a[smooth]\"]\n");
}

TEST(WriteLook, WhatIsWrongIsRefused) {
  EXPECT_NE(refusal("", {"tone.gamma=-1"}).find("tone.gamma is -1"), std::string::npos);
  EXPECT_NE(refusal("", {"tone.gama=1"}).find("gama"), std::string::npos);
  EXPECT_NE(refusal("[tone\n", {"tone.gamma=1"}).find("a.toml:1"), std::string::npos);
  EXPECT_EQ(refusal("", {"style={}"}), "--set style={}: expected section.key=value");
}

TEST(WriteLook, WhatWasThereCanBeBroughtBack) {
  const std::string text = "[tone]\ngamma = 2.0\n[[style]]\nstrip = \"a.png\"\n";
  const std::vector<std::string> overrides{"tone.gamma=1.5", "smooth.h=9",
                                           "style[0].strip=\"b.png\""};
  const WrittenLook after = writeOverrides(text, "a.toml", overrides);
  EXPECT_EQ(resolvedText(readLookText(after.text, "a.toml", after.before)),
            resolvedText(readLookText(text, "a.toml", {})));
}

// Every key that a look has, in every scope and in every way that a section can be written.

std::string changedValue(const Parameter& p) {
  switch (p.type) {
    case ValueType::boolean:
      return std::get<bool>(p.defaultValue()) ? "false" : "true";
    case ValueType::choice:
      return fmt::format(
          "\"{}\"", std::get<int>(p.defaultValue()) == 0 ? p.choices.back() : p.choices.front());
    case ValueType::integer:
      return fmt::format(
          "{}",
          static_cast<int>(std::get<int>(p.defaultValue()) == p.minimum ? p.maximum : p.minimum));
    case ValueType::number:
      return fmt::format("{}", std::get<double>(p.defaultValue()) == p.minimum
                                   ? p.minimum + (p.maximum - p.minimum) / 8
                                   : p.minimum);
    case ValueType::text:
      return "\"other \\\"thing\\\" \\\\ é\"";
    case ValueType::texts:
      return "[\"one\", \"t'wo\"]";
    case ValueType::numbers: {
      const std::string number = fmt::format("{}", p.minimum + (p.maximum - p.minimum) / 4);
      std::string list = "[" + number;
      for (size_t i = 1; i < (p.count ? p.count : 3); ++i) list += ", " + number;
      return list + "]";
    }
  }
  return "";
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Whether all lines of `old` but at most `changed` of them are in `now`, in their order.
bool keepsLines(const std::string& old, const std::string& now, size_t changed) {
  const std::vector<std::string> before = linesOf(old), after = linesOf(now);
  size_t kept = 0, at = 0;
  for (const std::string& line : before) {
    const auto found =
        std::find(after.begin() + static_cast<std::ptrdiff_t>(at), after.end(), line);
    if (found == after.end()) continue;
    at = static_cast<size_t>(found - after.begin()) + 1;
    ++kept;
  }
  return kept + changed >= before.size();
}

void expectWritten(const std::string& text, const std::string& override) {
  SCOPED_TRACE(override + " in\n" + text);
  const std::string now = written(text, {override});
  EXPECT_EQ(resolvedText(readLookText(now, "a.toml", {})),
            resolvedText(readLookText(text, "a.toml", {override})));
  EXPECT_NE(now, text);
  EXPECT_TRUE(keepsLines(text, now, 1)) << now;
  // Written again it is the same; turned back it is in the same place.
  EXPECT_EQ(written(now, {override}), now);
  const WrittenLook first = writeOverrides(text, "a.toml", {override});
  const std::string back = written(now, first.before);
  EXPECT_EQ(resolvedText(readLookText(back, "a.toml", {})),
            resolvedText(readLookText(text, "a.toml", {})));
  EXPECT_EQ(linesOf(back).size(), linesOf(now).size());
}

/// Texts in which the section is written in all ways, or not at all.
std::vector<std::string> textsFor(Scope scope, const std::string& section, bool isOwn) {
  const std::string entry =
      scope == Scope::light ? "[[light]] # é\nname = \"Key\" # 影\n" : "[[style]] # é\n";
  const std::string start = "# first\nkagefude = 1\n";
  const std::string end = "\n# the last style\n[[style]]\nobject = \"Last\" # last\n";
  if (scope == Scope::look)
    return {"", start, start + end, start + "[" + section + "] # head\n" + end,
            start + section + " = {} # short\n" + end};
  const std::string name = scopeNames[static_cast<size_t>(scope)].data();
  std::vector<std::string> texts{start + entry, start + entry + end};
  texts.push_back(scope == Scope::light ? "light = [ { name = \"Key\" } ] # inline\n"
                                        : "style = [ { priority = 2 } ] # inline\n");
  if (!isOwn)
    texts.push_back(start + entry + "[" + name + "." + section + "] # head\n# in it\n" + end);
  return texts;
}

TEST(WriteLook, EveryKeyInEveryScopeIsWrittenAndNothingElse) {
  size_t keys = 0;
  for (const LookSection& section : lookSections)
    for (const Parameter& p : section.table->parameters)
      for (const Scope scope : {Scope::look, Scope::light, Scope::style}) {
        const std::string pass(section.table->pass);
        const bool isOwn = pass == scopeNames[static_cast<size_t>(scope)];
        if (!isOwn && !actsIn(scope, section, p.name)) continue;
        const std::string prefix =
            scope == Scope::look ? ""
                                 : std::string(scopeNames[static_cast<size_t>(scope)]) + "[0].";
        const std::string key = fmt::format("{}{}{}", prefix, isOwn ? "" : pass + ".", p.name);
        for (const std::string& text : textsFor(scope, pass, isOwn))
          expectWritten(text, key + "=" + changedValue(p));
        ++keys;
      }
  EXPECT_GT(keys, 200u);
}

class SavedLook : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  static std::string contentOf(const std::filesystem::path& path) { return TestFolder::read(path); }

  TestFolder folder_;
};

TEST_F(SavedLook, WhatOthersWroteSinceStays) {
  const std::filesystem::path path = file("a.toml", "[tone]\ngamma = 2\n");
  file("a.toml", "# by hand\n[tone]\ngamma = 2\nblack = 0.1\n");
  saveLook(path, {"tone.gamma=1.5"});
  EXPECT_EQ(contentOf(path), "# by hand\n[tone]\ngamma = 1.5\nblack = 0.1\n");
}

TEST_F(SavedLook, ALinkAndTheRightsStay) {
  namespace fs = std::filesystem;
  const fs::path path = file("a.toml", "[tone]\ngamma = 2\n");
  const fs::perms rights = fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read;
  fs::permissions(path, rights);
  fs::create_symlink("a.toml", folder_ / "link.toml");
  saveLook(folder_ / "link.toml", {"tone.gamma=1.5"});
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.toml"));
  EXPECT_EQ(contentOf(path), "[tone]\ngamma = 1.5\n");
  EXPECT_EQ(fs::status(path).permissions(), rights);
}

TEST_F(SavedLook, AnErrorLeavesTheFileAsItIs) {
  const std::string broken = "[tone]\ngamma = 2\nblack = \n";
  const std::filesystem::path path = file("a.toml", broken);
  EXPECT_THROW(saveLook(path, {"tone.gamma=1.5"}), LookError);
  EXPECT_EQ(contentOf(path), broken);
  EXPECT_THROW(saveLook(folder_ / "none.toml", {"tone.gamma=1.5"}), OutputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.toml"));
  EXPECT_THROW(saveLook("", {"tone.gamma=1.5"}), OutputError);
  EXPECT_THROW(saveLook("/dev/null", {"tone.gamma=1.5"}), OutputError);
}

}  // namespace
}  // namespace kagefude
