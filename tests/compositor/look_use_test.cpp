#include "compositor/look_use.h"

#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

class UseOfALook : public ::testing::Test {
 protected:
  Look lookOf(const std::string& text) {
    writeText(folder_ / "look.toml", text);
    return readLook(folder_ / "look.toml", {});
  }
  FramePlan planWith(const std::vector<std::string>& objects) {
    FramePlan plan;
    uint32_t id = 1;
    for (const std::string& name : objects) plan.listedNames[id++] = name;
    plan.lights.emplace_back().name = "Key";
    return plan;
  }
  TemporaryFolder folder_;
};

TEST_F(UseOfALook, NamesOfAnyFrameCount) {
  const Look look = lookOf("[[style]]\nobject = \"Ball\"\n");
  LookUse all = lookUse(look, planWith({"Floor"}), {false});
  EXPECT_EQ(unusedEntries(look, all).size(), 1u);
  all.add(lookUse(look, planWith({"Floor", "Ball"}), {false}));
  EXPECT_TRUE(unusedEntries(look, all).empty());
}

TEST_F(UseOfALook, SeenSurfacesCountWithoutNames) {
  const Look look = lookOf("[[style]]\nobject = \"Ball\"\n");
  EXPECT_TRUE(unusedEntries(look, lookUse(look, planWith({}), {true})).empty());
}

TEST_F(UseOfALook, TheNearestNameIsSaid) {
  const Look look = lookOf(
      "[shadow]\nlights = [\"Key\", \"Rimm*\"]\n"
      "[[light]]\nname = \"Kex*\"\n[[style]]\nobject = \"Bal\"\n");
  const auto texts = unusedEntries(look, lookUse(look, planWith({"Ball", "Floor"}), {false}));
  ASSERT_EQ(texts.size(), 3u);
  expectContains(texts[0], "object Bal (did you mean Ball?)");
  expectContains(texts[1], "a [[light]] names Kex*");
  expectContains(texts[2], "shadow.lights names Rimm*");
}

}  // namespace
}  // namespace kagefude
