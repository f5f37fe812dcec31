#include "passes/search/pixel_set.h"

#include <gtest/gtest.h>

#include "passes/random_image.h"

namespace kagefude {
namespace {

TEST(PixelSet, NumbersPixelsInRasterOrder) {
  const Bytes kinds = test::randomKinds(131, 17, 4, 0, 2);
  const PixelSet set(kinds, 2, 3);
  uint32_t count = 0;
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 131; ++x) {
      EXPECT_EQ(set.contains(x, y), kinds(x, y) >= 2);
      if (set.contains(x, y)) {
        EXPECT_EQ(set.indexOf(x, y), count++);
      }
      for (int i = 0; x % 32 == 0 && i < 32; ++i) {
        EXPECT_EQ(set.bits32(x, y) >> i & 1, x + i < 131 && kinds(x + i, y) >= 2);
      }
    }
  EXPECT_EQ(set.size(), count);
}

TEST(PixelSet, EndsOfARunEqualTheNaiveSearch) {
  const Bytes kinds = test::randomKinds(200, 3, 2, 30, 4);
  const PixelSet set(kinds, 1, 1);
  for (int y = 0; y < 3; ++y)
    for (int from = 0; from < 200; from += 7)
      for (int end = from + 1; end <= 200; end += 13) {
        int first = end, last = end;
        for (int x = from; x < end; ++x)
          if (kinds(x, y)) first = std::min(first, x), last = x + 1;
        EXPECT_EQ(set.ends(from, end, y), std::pair(first, last));
      }
}

TEST(PixelSet, EmptyOnes) {
  EXPECT_EQ(PixelSet().size(), 0u);
  EXPECT_EQ(PixelSet(Bytes(70, 3, uint8_t{0}), 1, 9).size(), 0u);
}

}  // namespace
}  // namespace kagefude
