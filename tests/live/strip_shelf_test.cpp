#include "live/strip_shelf.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "exr/write_image.h"
#include "test_folder.h"

namespace kagefude {
namespace {

class SpareStrips : public ::testing::Test {
 protected:
  void writeStrip(const std::string& name, float grey) const {
    const Floats plane(16, 16, grey);
    writePng(folder_ / name, plane, plane, plane);
  }
  /// Where the strip's texels lie, of a look whose only style has it.
  const Rgba* show(StripShelf& shelf, const std::string& name) {
    const Look look = readLookText("[[style]]\nobject = \"A\"\nstrip = \"" + name + "\"\n",
                                   folder_ / "look.toml", {});
    StageRun run;
    const Made<StripSet> set = shelf.stripsOf(look, shelf.colourOf(look, run), run);
    return set->strips()[static_cast<size_t>(set->indexOf(name))].pool.row(0);
  }

  TestFolder folder_;
};

TEST_F(SpareStrips, GoingBackToOneLoadsNothing) {
  writeStrip("a.png", 0.2f);
  writeStrip("b.png", 0.4f);
  StripShelf shelf;
  const Rgba* const a = show(shelf, "a.png");
  const Rgba* const b = show(shelf, "b.png");
  EXPECT_NE(a, b);
  EXPECT_EQ(show(shelf, "a.png"), a);
  EXPECT_EQ(show(shelf, "b.png"), b);
}

TEST_F(SpareStrips, OneThatHasChangedOnDiskIsLoadedAgain) {
  writeStrip("a.png", 0.2f);
  writeStrip("b.png", 0.4f);
  StripShelf shelf;
  const float before = (*show(shelf, "a.png"))[0];
  show(shelf, "b.png");
  writeStrip("a.png", 0.6f);
  EXPECT_GT((*show(shelf, "a.png"))[0], before);
}

TEST_F(SpareStrips, TheyStayWithinTheirBytes) {
  for (const char* name : {"a.png", "b.png", "c.png"}) writeStrip(name, 0.2f);
  StripShelf shelf(16 * 16 * 30);  // one of them
  const Rgba* const a = show(shelf, "a.png");
  show(shelf, "b.png");
  EXPECT_EQ(show(shelf, "a.png"), a);
  show(shelf, "b.png");
  show(shelf, "c.png");  // now b is spare, and a is gone
  folder_.write("a.png", "no picture any more");
  EXPECT_THROW(show(shelf, "a.png"), InputError);
}

TEST_F(SpareStrips, OneThatIsMissingIsCalledByItsLineWhateverElseIsThere) {
  writeStrip("a.png", 0.2f);
  StripShelf shelf;
  show(shelf, "a.png");
  const Look look = readLookText(
      "[[style]]\nobject = \"A\"\nstrip = \"a.png\"\n[[style]]\nstrip = \"none.png\"\n",
      folder_ / "look.toml", {});
  StageRun run;
  const std::string said =
      messageOf<InputError>([&] { shelf.stripsOf(look, shelf.colourOf(look, run), run); });
  EXPECT_NE(said.find("look.toml:5: style[1].strip: "), std::string::npos) << said;
}

TEST_F(SpareStrips, AStripThatCannotBeReadLosesNoOther) {
  writeStrip("a.png", 0.2f);
  StripShelf shelf;
  const Rgba* const a = show(shelf, "a.png");
  folder_.write("b.png", "no picture");
  EXPECT_THROW(show(shelf, "b.png"), InputError);
  EXPECT_EQ(show(shelf, "a.png"), a);
}

}  // namespace
}  // namespace kagefude
