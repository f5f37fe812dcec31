#include "sequence/memory_bound.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace kagefude {
namespace {

TEST(MemoryBound, ReadsAmounts) {
  EXPECT_EQ(parseMemory("2000"), 2000u);
  EXPECT_EQ(parseMemory("8G"), size_t{8} << 30);
  EXPECT_EQ(parseMemory("512m"), size_t{512} << 20);
  EXPECT_EQ(parseMemory("1.5 GiB"), size_t{3} << 29);
  EXPECT_EQ(parseMemory("1TB"), size_t{1} << 40);
}

TEST(MemoryBound, RefusesWhatIsNoAmount) {
  for (const char* text : {"", "G", "0", "-1", "1X", "1e", "nan", "inf", "0x10", "1GG", "0.1",
                           "8G8", " 8G", "99999999T"})
    EXPECT_THROW(parseMemory(text), UsageError) << text;
}

TEST(MemoryBound, FormatsForMessages) {
  EXPECT_EQ(formatMemory(12), "12 bytes");
  EXPECT_EQ(formatMemory(size_t{3} << 29), "1.5 GiB");
}

TEST(MemoryBound, DefaultIsWithinWhatMachinesHave) {
  EXPECT_GE(defaultMemoryBound(), size_t{64} << 20);
  EXPECT_LT(defaultMemoryBound(), size_t{1} << 50);
}

}  // namespace
}  // namespace kagefude
