#include "live/stage_key.h"

#include <gtest/gtest.h>

#include "look/look_sections.h"

namespace kagefude {
namespace {

TEST(StageKey, TextsDoNotRunIntoEachOther) {
  EXPECT_FALSE(StageKey().add("ab").add("c") == StageKey().add("a").add("bc"));
  EXPECT_TRUE(StageKey().add("ab").add("c") == StageKey().add("ab").add("c"));
}

TEST(StageKey, EveryParameterOfEveryTableCounts) {
  for (const LookSection& section : lookSections) {
    if (!section.inLook) continue;
    for (const Parameter& parameter : section.table->parameters) {
      Look before, after;
      void* const values = section.inLook(after);
      Value value = parameter.get(values);
      if (auto* flag = std::get_if<bool>(&value)) *flag = !*flag;
      if (auto* whole = std::get_if<int>(&value)) *whole += *whole > 0 ? -1 : 1;
      if (auto* number = std::get_if<double>(&value)) *number += 1;
      if (auto* text = std::get_if<std::string>(&value)) *text += "x";
      if (auto* numbers = std::get_if<std::vector<double>>(&value)) numbers->push_back(1);
      if (auto* texts = std::get_if<std::vector<std::string>>(&value)) texts->push_back("x");
      parameter.set(values, value);
      EXPECT_FALSE(StageKey().add(*section.table, section.inLook(before)) ==
                   StageKey().add(*section.table, values))
          << section.table->pass << "." << parameter.name;
      EXPECT_TRUE(StageKey().add(*section.table, section.inLook(before), {parameter.name}) ==
                  StageKey().add(*section.table, values, {parameter.name}))
          << section.table->pass << "." << parameter.name;
    }
  }
}

}  // namespace
}  // namespace kagefude
