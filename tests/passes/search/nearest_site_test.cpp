#include "passes/search/nearest_site.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "base/error.h"
#include "passes/random_image.h"

namespace kagefude {
namespace {

using test::equalBits;
using test::randomKinds;
using test::randomLabels;

struct Found {
  Labels squared, index;
};

Found search(const SiteSearch& s) {
  Found f{{s.kinds.width, s.kinds.height}, {s.kinds.width, s.kinds.height}};
  findNearestSites(s, findLabelBoxes(s), f.squared, f.index);
  return f;
}

/// Looks at every site for every wanted pixel, in raster order, so the first of equals wins.
Found naive(const SiteSearch& s) {
  const int w = s.kinds.width, h = s.kinds.height;
  Found f{{w, h, noSite}, {w, h, noSite}};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const uint32_t label = s.labels.empty() ? 1 : s.labels(x, y);
      if (s.wantedKinds(x, y) != s.wantedKind || label == 0) continue;
      for (int v = 0; v < h; ++v)
        for (int u = 0; u < w; ++u) {
          if (s.kinds(u, v) != s.siteKind) continue;
          if (!s.labels.empty() && s.labels(u, v) != label) continue;
          const uint32_t d2 = static_cast<uint32_t>((u - x) * (u - x) + (v - y) * (v - y));
          if (d2 >= f.squared(x, y)) continue;
          f.squared(x, y) = d2;
          f.index(x, y) = static_cast<uint32_t>(v * w + u);
        }
    }
  return f;
}

void expectNaive(const SiteSearch& s, const char* what) {
  const Found fast = search(s), slow = naive(s);
  EXPECT_TRUE(equalBits<uint32_t>(fast.squared, slow.squared)) << what;
  EXPECT_TRUE(equalBits<uint32_t>(fast.index, slow.index)) << what;
}

TEST(NearestSite, BoxesWithinAReachFindWhatLiesInIt) {
  constexpr int width = 300, height = 290;
  const Bytes kinds = randomKinds(width, height, 3, 0, 11);
  Bytes sites(width, height, uint8_t{0}), wanted(width, height, uint8_t{0});
  // Sites thinly spread and round two wanted places, one at a corner, one over a box's border.
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      sites(x, y) = kinds(x, y) == 1 && (x * 7 + y * 3) % 29 == 0 ? 1 : 0;
      const bool corner = x < 9 && y<14, middle = x> 120 && x < 150 && y > 120 && y < 135;
      wanted(x, y) = corner || middle ? 1 : 0;
    }
  const SiteSearch s{sites, 1, wanted, 1, {}};
  const std::vector<LabelBox> boxes = boxesWithin(wanted, 1, 6.0f);
  ASSERT_EQ(boxes.size(), 2u);
  Found near{{width, height, 77u}, {width, height, 77u}};
  findNearestSites(s, boxes, near.squared, near.index);
  const Found whole = search(s);
  int within = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!wanted(x, y) || whole.squared(x, y) > 36) continue;
      ++within;
      ASSERT_EQ(near.squared(x, y), whole.squared(x, y)) << x << " " << y;
      ASSERT_EQ(near.index(x, y), whole.index(x, y)) << x << " " << y;
    }
  EXPECT_GT(within, 300);
  EXPECT_EQ(near.squared(250, 60), 77u) << "what is far from all wanted pixels is not looked at";
  EXPECT_EQ(boxesWithin(wanted, 1, 500.0f).size(), 1u) << "the frame, for boxes would overlap";
  EXPECT_TRUE(boxesWithin(Bytes(50, 40, uint8_t{0}), 1, 6.0f).empty());
}

TEST(NearestSite, EqualsTheNaiveSearchWithoutBounds) {
  for (const int rare : {0, 30, 2}) {
    const Bytes kinds = randomKinds(133, 71, 3, rare, 7);
    expectNaive({kinds, 1, kinds, 2, {}}, "penumbra to umbra");
    expectNaive({kinds, 1, kinds, 0, {}}, "to a rare kind");
    expectNaive({kinds, 1, kinds, 1, {}}, "sites themselves");
  }
}

TEST(NearestSite, EqualsTheNaiveSearchWithinManyLabels) {
  uint32_t seed = 1;
  for (const int count : {2, 5, 40, 700})
    for (const int cell : {1, 4, 19})
      for (const int rare : {0, 40}) {
        const Bytes kinds = randomKinds(97, 83, 3, rare, ++seed);
        const Labels labels = randomLabels(97, 83, count, cell, ++seed);
        expectNaive({kinds, 1, kinds, 2, labels}, "labels");
        expectNaive({kinds, 2, kinds, 0, labels}, "labels, rare sites");
      }
}

TEST(NearestSite, IsExactBeyondTheBlockSearch) {
  Bytes kinds(700, 420, 0);
  kinds(3, 2) = kinds(690, 10) = kinds(350, 417) = kinds(351, 3) = 1;
  const SiteSearch s{kinds, 1, kinds, 0, {}};
  const Found fast = search(s);
  const int sites[][2] = {{3, 2}, {351, 3}, {690, 10}, {350, 417}};
  for (int y = 0; y < 420; y += 7)
    for (int x = 0; x < 700; x += 3) {
      uint32_t best = noSite;
      for (const auto& [u, v] : sites)
        best = std::min(best, static_cast<uint32_t>((u - x) * (u - x) + (v - y) * (v - y)));
      ASSERT_EQ(fast.squared(x, y), kinds(x, y) == 0 ? best : noSite) << x << " " << y;
    }
}

TEST(NearestSite, EqualDistancesGoToTheUpperThenTheLeftSite) {
  Bytes kinds(3, 3, 0);
  kinds(1, 0) = kinds(0, 1) = kinds(2, 1) = kinds(1, 2) = 1;
  EXPECT_EQ(search({kinds, 1, kinds, 0, {}}).index(1, 1), 1u);
  kinds(1, 0) = kinds(1, 2) = 0;
  EXPECT_EQ(search({kinds, 1, kinds, 0, {}}).index(1, 1), 3u) << "left of two in one row";
}

TEST(NearestSite, BackgroundIsNeitherSiteNorWanted) {
  const Bytes kinds(5, 1, 1);
  Labels labels(5, 1, 0);
  labels(4, 0) = 9;
  const Found f = search({kinds, 1, kinds, 1, labels});
  EXPECT_EQ(f.squared(0, 0), noSite);
  EXPECT_EQ(f.squared(4, 0), 0u);
}

TEST(NearestSite, NoSiteOfTheLabel) {
  Bytes kinds(300, 2, 0);
  kinds(0, 0) = 1;
  Labels labels(300, 2, 2);
  labels(0, 0) = 1;
  const Found f = search({kinds, 1, kinds, 0, labels});
  EXPECT_EQ(f.squared(299, 1), noSite);
  EXPECT_EQ(f.index(1, 0), noSite);
}

TEST(NearestSite, OnePixelAndOneRowFrames) {
  const Bytes one(1, 1, 1);
  EXPECT_EQ(search({one, 1, one, 1, {}}).squared(0, 0), 0u);
  EXPECT_EQ(search({one, 0, one, 1, {}}).squared(0, 0), noSite);
  Bytes row(1000, 1, 0);
  row(999, 0) = 1;
  EXPECT_EQ(search({row, 1, row, 0, {}}).squared(0, 0), 999u * 999u);
  Bytes column(1, 1000, 0);
  column(0, 0) = 1;
  EXPECT_EQ(search({column, 1, column, 0, {}}).squared(0, 999), 999u * 999u);
}

TEST(NearestSite, SameBitsForAnyNumberOfThreads) {
  const Bytes kinds = randomKinds(500, 300, 3, 20, 3);
  const Labels labels = randomLabels(500, 300, 300, 11, 4);
  const SiteSearch s{kinds, 1, kinds, 0, labels};
  const Found all = search(s);
  for (const size_t threads : {1, 2, 4}) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Found some = search(s);
    EXPECT_TRUE(equalBits<uint32_t>(some.squared, all.squared)) << threads;
    EXPECT_TRUE(equalBits<uint32_t>(some.index, all.index)) << threads;
  }
}

TEST(NearestSite, RefusesPlanesOfOtherSizes) {
  const Bytes kinds(4, 4, 1), other(4, 5, 1);
  Labels squared(4, 4);
  EXPECT_THROW(findLabelBoxes({kinds, 1, other, 1, {}}), InputError);
  Labels small(3, 4);
  const SiteSearch s{kinds, 1, kinds, 1, {}};
  EXPECT_THROW(findNearestSites(s, findLabelBoxes(s), small), InputError);
}

}  // namespace
}  // namespace kagefude
