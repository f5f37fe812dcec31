#include "look/shadow_methods.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "look/look_sections.h"
#include "look/sections.h"

namespace kagefude {
namespace {

TEST(ShadowMethods, AreNamedAndDescribedOnceEach) {
  std::set<std::string_view> names, sentences;
  for (const ShadowMethodEntry& entry : shadowMethods) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_TRUE(sentences.insert(entry.sentence).second) << entry.name;
    EXPECT_FALSE(entry.sentence.empty()) << entry.name;
    EXPECT_EQ(&entryOf(entry.method), &entry);
  }
}

TEST(ShadowMethods, AllButAutomaticHaveAFunction) {
  for (const ShadowMethodEntry& entry : shadowMethods)
    EXPECT_EQ(entry.function != nullptr, entry.method != ShadowMethod::automatic) << entry.name;
}

TEST(ShadowMethods, NeedsHoldTogether) {
  for (const ShadowMethodEntry& entry : shadowMethods) {
    const MaskNeed& masks = entry.needs.masks;
    EXPECT_EQ(masks.fewest > 0, !masks.exportAs.empty()) << entry.name;
    EXPECT_TRUE(masks.most == 0 || masks.most >= masks.fewest) << entry.name;
    // Rays of the camera are what meets the casters.
    EXPECT_TRUE(entry.needs.camera || !(entry.needs.casters || entry.cutsMasks)) << entry.name;
    EXPECT_TRUE(entry.bytes.perMask == 0 || masks.fewest > 0 || entry.cutsMasks) << entry.name;
  }
}

TEST(ShadowMethods, TheLookTakesThemAllAndTellsOfThem) {
  const Parameter& method = shadowTable.parameters.front();
  ASSERT_EQ(method.name, "method");
  ASSERT_EQ(method.choices.size(), shadowMethods.size());
  for (size_t i = 0; i < shadowMethods.size(); ++i) {
    EXPECT_EQ(method.choices[i], shadowMethods[i].name);
    const std::string told =
        std::string(shadowMethods[i].name) + ": " + std::string(shadowMethods[i].sentence);
    EXPECT_NE(method.help.find(told), std::string_view::npos) << told;
  }
}

}  // namespace
}  // namespace kagefude
