#include "base/printable.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

TEST(Printable, NamesStayAsTheyAre) {
  EXPECT_EQ(printable("shot.0001.exr: 影筆, Größe 3 × 4"), "shot.0001.exr: 影筆, Größe 3 × 4");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, NoNameBeginsALineOfItsOwn) {
  EXPECT_EQ(printable("Ball\nERROR: stop"), "Ball\\nERROR: stop");
  EXPECT_EQ(printable("a\rb\tc"), "a\\rb\\tc");
  EXPECT_EQ(printable("a\xe2\x80\xa8openjd_fail: b"), "a\\xe2\\x80\\xa8openjd_fail: b");
}

TEST(Printable, NoNameCommandsATerminal) {
  EXPECT_EQ(printable("\x1b[2Jx"), "\\x1b[2Jx");
  EXPECT_EQ(printable("\x7f"), "\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // the C1 form of ESC [
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "gpj"),
            "\\xe2\\x80\\xaegpj");  // right to left from here
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Printable, BytesThatAreNoTextAreSpelled) {
  EXPECT_EQ(printable("\x9b"
                      "a"),
            "\\x9ba");
  EXPECT_EQ(printable("\xe5\xbd"), "\\xe5\\xbd");           // cut
  EXPECT_EQ(printable("\xc0\x8a"), "\\xc0\\x8a");           // a line break, overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // a surrogate
}

TEST(Printable, LinesStayLines) {
  EXPECT_EQ(printableLines("{\n  \"a\": 1\x7f\n}"), "{\n  \"a\": 1\\x7f\n}");
  EXPECT_EQ(printableLines("a\n"), "a\n");
}

}  // namespace
}  // namespace kagefude
