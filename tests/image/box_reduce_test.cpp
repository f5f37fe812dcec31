#include "image/box_reduce.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

TEST(BoxReduce, SpansFollowEachOtherAndCoverAll) {
  for (int large = 1; large <= 40; ++large)
    for (int small = 1; small <= large; ++small) {
      int next = 0;
      for (int i = 0; i < small; ++i) {
        const BoxSpan span = boxSpan(i, large, small);
        EXPECT_EQ(span.first, next);
        EXPECT_GT(span.end, span.first);
        next = span.end;
      }
      EXPECT_EQ(next, large);
    }
}

TEST(BoxReduce, LargeSidesDoNotOverflow) {
  const BoxSpan last = boxSpan(319, 1 << 30, 320);
  EXPECT_EQ(last.end, 1 << 30);
  EXPECT_EQ(last.end - last.first, (1 << 30) - last.first);
}

TEST(BoxReduce, SumsABox) {
  const BoxSpan across{1, 3}, down{2, 5};
  EXPECT_EQ(pixelsIn(across, down), 6);
  // x: 1 + 2 in each of three rows; 10 y: 20 + 30 + 40 in each of two columns.
  EXPECT_EQ(boxSum<int>(across, down, [](int x, int y) { return x + 10 * y; }), 9 + 180);
}

}  // namespace
}  // namespace kagefude
