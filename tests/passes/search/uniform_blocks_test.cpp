#include "passes/search/uniform_blocks.h"

#include <gtest/gtest.h>

#include "passes/random_image.h"

namespace kagefude {
namespace {

TEST(UniformBlocks, MarginsHoldOneLabelInsideTheFrame) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const Labels labels = test::randomLabels(155, 113, 3, 40, seed);
    const UniformBlocks blocks(labels);
    int known = 0;
    for (int y = 0; y < 113; ++y)
      for (int x = 0; x < 155; ++x) {
        const int margin = blocks.margin(x, y);
        known += margin > 0;
        for (int v = y - margin; v <= y + margin; v += std::max(1, 2 * margin))
          for (int u = x - margin; u <= x + margin; ++u) {
            ASSERT_TRUE(labels.view().contains(u, v)) << x << " " << y;
            ASSERT_EQ(labels(u, v), labels(x, y)) << x << " " << y;
          }
      }
    EXPECT_GT(known, 100);
  }
}

TEST(UniformBlocks, OneLabelReachesToTheFramesEdge) {
  const UniformBlocks blocks(Labels(80, 80, 1u));
  EXPECT_EQ(blocks.margin(0, 40), 0);
  EXPECT_EQ(blocks.margin(8, 40), 8);
  EXPECT_EQ(blocks.margin(39, 40), 32);
}

TEST(UniformBlocks, BlockThatTheFrameCutsIsNotKnown) {
  const UniformBlocks blocks(Labels(20, 16, 1u));
  EXPECT_LT(blocks.margin(18, 3), 0);
  EXPECT_EQ(blocks.margin(3, 3), 0);
}

}  // namespace
}  // namespace kagefude
