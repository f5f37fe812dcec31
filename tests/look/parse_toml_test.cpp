#include "look/parse_toml.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "look/override.h"
#include "test_folder.h"

namespace kagefude {
namespace {

std::string repeated(const std::string& part, size_t times) {
  std::string text;
  for (size_t i = 0; i < times; ++i) text += part;
  return text;
}

toml::table parse(const std::string& text) { return parseToml(text, "look"); }

TEST(ParseToml, TakesWhatLooksAreMadeOf) {
  const toml::table table = parse(
      "# a.b.c. [[[[\n[frame]\nposition = \"a.b.c.d.e\" # {{{\n[[light]]\nname = '''x.y\n[[[z'''\n"
      "shadow.method = \"pair\"\nsmooth = {h = 1.5, w = [1.0, 2.0]}\n[[style]]\nobject = \"*\"\n");
  EXPECT_EQ(table.size(), 3u);
}

TEST(ParseToml, ManySectionsAreNotDeepOnes) {
  parse(repeated("[[style]]\nbrush.width = 1.5\nbrush.list = [1.0, 2.0, 3.0]\n", 1000));
}

// The first two ended in a stack overflow.
TEST(ParseToml, DeepNestingIsRefusedWhereverItStands) {
  for (const std::string& text :
       {repeated("a.", 32000) + "a = 1", "[" + repeated("a.", 32000) + "a]\n",
        "[[" + repeated("a.", 32000) + "a]]\n", "a = " + repeated("[", 32000),
        "a = " + repeated("{a = ", 32000), repeated("\"a\" . ", 32000) + "a = 1",
        "[" + repeated("a.", 40) + "a]\n" + repeated("b.", 40) + "b = 1",
        "x = {" + repeated("a.", 40) + "a = {" + repeated("b.", 40) + "b = 1}}"}) {
    EXPECT_THROW(parse(text), LookError) << text.substr(0, 60);
  }
}

TEST(ParseToml, NamesTheLine) {
  try {
    parse("[frame]\n# one\nframe = '''\n\n'''\n" + repeated("a.", 100) + "a = 1");
    FAIL();
  } catch (const LookError& error) {
    EXPECT_NE(std::string(error.what()).find("look:6"), std::string::npos) << error.what();
  }
}

TEST(ParseToml, OverridesAreBoundAsWell) {
  toml::table look;
  EXPECT_THROW(applyOverride(look, repeated("a.", 32000) + "a=1"), LookError);
  EXPECT_THROW(applyOverride(look, "a.b={" + repeated("a.", 32000) + "a=1}"), LookError);
  EXPECT_THROW(applyOverride(look, "a.b=" + repeated("[", 32000)), LookError);
}

// What came after the line break was dropped without a word.
TEST(ParseToml, AnOverrideSetsOneValue) {
  for (const char* more :
       {"\nnonsense=7", "\n[brush]", "\r\n[[style]]\nobject = \"a\"", "\na.b=1"}) {
    toml::table look;
    const std::string message =
        messageOf<LookError>([&] { applyOverride(look, std::string("edges.rough=20") + more); });
    EXPECT_NE(message.find("--set edges.rough: there is more than one value"), std::string::npos)
        << more;
    EXPECT_THROW(setValue(look, std::string("width=8") + more), LookError);
  }
  toml::table look;
  applyOverride(look, "edges.rough=20  # a remark\n");
  applyOverride(look, "edges.list=[\n1,\n2]");
  EXPECT_EQ(look["edges"]["rough"].value<int>(), 20);
  EXPECT_EQ(look["edges"]["list"].as_array()->size(), 2u);
}

}  // namespace
}  // namespace kagefude
