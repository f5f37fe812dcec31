#include "passes/edges/coverage_blend.h"

#include <gtest/gtest.h>

#include <limits>

namespace kagefude {
namespace {

// A row of three pixels: red thing 1, red thing 1, green thing 2.
struct Row {
  Floats r{3, 1, 1.0f}, g{3, 1, 0.0f}, b{3, 1, 0.0f}, a{3, 1, 1.0f};
  Labels own{3, 1, 1u};
  Labels first{3, 1, 1u}, second{3, 1, 0u};
  Floats firstShare{3, 1, 1.0f}, secondShare{3, 1, 0.0f};

  Row() {
    own(2, 0) = first(2, 0) = 2;
    r(2, 0) = 0;
    g(2, 0) = 1;
  }
  ColourPlanes blend() const {
    const CoverageRank ranks[] = {{first, firstShare}, {second, secondShare}};
    return blend(ranks);
  }
  ColourPlanes blend(std::span<const CoverageRank> ranks) const {
    ColourPlanes colour{r.clone(), g.clone(), b.clone(), a.clone()};
    blendByCoverage({colour.r, colour.g, colour.b, colour.a}, own, ranks);
    return colour;
  }
};

TEST(CoverageBlend, TwoStylesMeetByTheirShares) {
  Row row;
  row.firstShare(1, 0) = 0.75f;
  row.second(1, 0) = 2;
  row.secondShare(1, 0) = 0.25f;
  const ColourPlanes result = row.blend();
  EXPECT_FLOAT_EQ(result.r(1, 0), 0.75f);
  EXPECT_FLOAT_EQ(result.g(1, 0), 0.25f);
  EXPECT_FLOAT_EQ(result.a(1, 0), 1.0f);
  EXPECT_EQ(result.r(0, 0), 1.0f) << "covered by one thing: taken over";
  EXPECT_EQ(result.g(2, 0), 1.0f);
}

TEST(CoverageBlend, RanksMayBeSparse) {
  Row row;
  row.firstShare(1, 0) = 0.75f;
  row.second(1, 0) = 2;
  row.secondShare(1, 0) = 0.25f;
  SparsePlane id(3, 1), share(3, 1);
  id.setRow(0, row.second.row(0));
  share.setRow(0, row.secondShare.row(0));
  const CoverageRank ranks[] = {{row.first, row.firstShare}, {id, share}};
  const ColourPlanes whole = row.blend(), sparse = row.blend(ranks);
  for (int x = 0; x < 3; ++x) {
    EXPECT_EQ(sparse.r(x, 0), whole.r(x, 0));
    EXPECT_EQ(sparse.g(x, 0), whole.g(x, 0));
  }
}

TEST(CoverageBlend, BackgroundShareStaysEmpty) {
  Row row;
  row.firstShare(1, 0) = 0.4f;
  const ColourPlanes result = row.blend();
  EXPECT_FLOAT_EQ(result.a(1, 0), 0.4f);
  EXPECT_FLOAT_EQ(result.r(1, 0), 0.4f);
}

TEST(CoverageBlend, BackgroundPixelBorrowsFromItsNeighbour) {
  Row row;
  row.own(1, 0) = 0;
  row.r(1, 0) = row.a(1, 0) = 0;
  row.first(1, 0) = 2;
  row.firstShare(1, 0) = 0.3f;
  const ColourPlanes result = row.blend();
  EXPECT_FLOAT_EQ(result.g(1, 0), 0.3f);
  EXPECT_FLOAT_EQ(result.a(1, 0), 0.3f);
}

TEST(CoverageBlend, ThingFoundNowhereLeavesItsShareToTheOthers) {
  Row row;
  row.firstShare(1, 0) = 0.5f;
  row.second(1, 0) = 99;
  row.secondShare(1, 0) = 0.5f;
  const ColourPlanes result = row.blend();
  EXPECT_FLOAT_EQ(result.r(1, 0), 1.0f);
  EXPECT_FLOAT_EQ(result.a(1, 0), 1.0f);
  row.first(1, 0) = 98;
  EXPECT_FLOAT_EQ(row.blend().r(1, 0), 1.0f) << "nothing found: the pixel's own colour";
}

TEST(CoverageBlend, NoRanksAndBrokenShares) {
  Row row;
  const ColourPlanes plain = row.blend({});
  EXPECT_EQ(plain.r(1, 0), 1.0f);
  row.firstShare(1, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(row.blend().a(1, 0), 0.0f);
}

}  // namespace
}  // namespace kagefude
