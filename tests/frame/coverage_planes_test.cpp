#include "frame/coverage_planes.h"

#include <cmath>
#include <limits>

#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

CoveragePlanes onePixel(const std::vector<std::pair<uint32_t, float>>& ranks) {
  CoveragePlanes coverage;
  for (const auto& [id, share] : ranks) {
    if (coverage.empty()) {
      coverage.firstId = Labels(1, 1, id);
      coverage.firstShare = Floats(1, 1, share);
      continue;
    }
    coverage.otherIds.emplace_back(1, 1).setRow(0, &id);
    coverage.otherShares.emplace_back(1, 1).setRow(0, &share);
  }
  return coverage;
}

TEST(CoveragePlanes, TheLargestCoverageIsDominant) {
  EXPECT_EQ(dominantIds(onePixel({{5, 0.25f}, {6, 0.75f}}))(0, 0), 6u);
  EXPECT_EQ(dominantIds(onePixel({{5, 0.5f}, {6, 0.5f}}))(0, 0), 5u) << "the lower rank wins ties";
  EXPECT_EQ(dominantIds(onePixel({{5, 0.0f}}))(0, 0), 0u) << "no coverage is background";
  EXPECT_EQ(dominantIds(onePixel({{5, std::nanf("")}, {6, 0.1f}}))(0, 0), 6u);
  EXPECT_TRUE(dominantIds(CoveragePlanes{}).empty());
}

TEST(CoveragePlanes, ImpossibleCoverageInAnyRankMakesThePixelWhollyItsFirst) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  for (const float wrong : {std::nanf(""), infinite, -infinite, 2.0f, -0.6f})
    for (const size_t rank : {0, 1, 2}) {
      std::vector<std::pair<uint32_t, float>> ranks{{5, 0.5f}, {6, 0.25f}, {7, 0.25f}};
      ranks[rank].second = wrong;
      CoveragePlanes coverage = onePixel(ranks);
      EXPECT_EQ(clearImpossibleCoverage(coverage), 1u);
      EXPECT_EQ(coverage.share(0, 0, 0), 1.0f);
      EXPECT_EQ(coverage.share(1, 0, 0), 0.0f);
      EXPECT_EQ(coverage.share(2, 0, 0), 0.0f);
      EXPECT_EQ(coverage.id(2, 0, 0), 7u);
    }
}

TEST(CoveragePlanes, CoverageThatAFilterOvershootsStays) {
  CoveragePlanes coverage = onePixel({{5, 1.2f}, {6, -0.2f}});
  EXPECT_EQ(clearImpossibleCoverage(coverage), 0u);
  EXPECT_EQ(coverage.share(0, 0, 0), 1.2f);
  EXPECT_EQ(coverage.share(1, 0, 0), -0.2f);
}

}  // namespace
}  // namespace kagefude
