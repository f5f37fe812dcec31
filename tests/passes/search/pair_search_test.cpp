#include "passes/search/pair_search.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/error.h"
#include "passes/random_image.h"

namespace kagefude {
namespace {

using test::equalBits;

/// Masks from a drawing: '#' hidden in both, '.' seen by both, '+' hidden in one, ' ' background.
struct Drawing {
  Bytes farMask, nearMask;
  Labels labels;

  explicit Drawing(const std::vector<std::string>& rows)
      : farMask(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), 1),
        nearMask(farMask.width(), farMask.height(), 1),
        labels(farMask.width(), farMask.height(), 1) {
    for (int y = 0; y < farMask.height(); ++y)
      for (int x = 0; x < farMask.width(); ++x) {
        const char c = rows[static_cast<size_t>(y)][static_cast<size_t>(x)];
        farMask(x, y) = c != '#';
        nearMask(x, y) = c == '.';
        labels(x, y) = c != ' ';
      }
  }
  Floats visibility(const PairParams& params = {}) const {
    return pairVisibility(farMask, nearMask, labels, params);
  }
};

PairParams gridOf(int step, bool adaptive = false) {
  PairParams params;
  params.search = PairSearch::grid;
  params.step = step;
  params.adaptive = adaptive;
  return params;
}

TEST(PairSearch, RatioByHand) {
  // 3.3 and 3.4: at column 2, D1 = 1, D2 = 3, v = 1/4.
  const Floats v = Drawing({"##+++."}).visibility();
  const float expected[] = {0, 0, 0.25f, 0.5f, 0.75f, 1};
  for (int x = 0; x < 6; ++x) EXPECT_EQ(v(x, 0), expected[x]) << x;
}

TEST(PairSearch, DistanceIsEuclidean) {
  const Floats v = Drawing({"#...", "++++", "++++", "+++."}).visibility();
  const float d1 = std::sqrt(2.0f), d2 = 1.0f;  // from (1,1) to (0,0) and to (1,0)
  EXPECT_FLOAT_EQ(v(1, 1), d1 / (d1 + d2));
}

TEST(PairSearch, MasksMayBeSwapped) {
  const Drawing d({"#+.+#", ".+#++"});
  EXPECT_TRUE(equalBits<float>(pairVisibility(d.farMask, d.nearMask, d.labels, {}),
                               pairVisibility(d.nearMask, d.farMask, d.labels, {})));
}

TEST(PairSearch, BackgroundIsLitAndNoSite) {
  const Floats v = Drawing({"# ++."}).visibility();
  EXPECT_EQ(v(1, 0), 1.0f);
  EXPECT_FLOAT_EQ(v(2, 0), 2.0f / 4.0f);
}

TEST(PairSearch, NoUmbraFallsFromOneToOneHalf) {
  const Floats v = Drawing({".+++++"}).visibility();
  const float deepest = 5;
  for (int x = 1; x < 6; ++x)
    EXPECT_FLOAT_EQ(v(x, 0), deepest / (deepest + static_cast<float>(x))) << x;
  EXPECT_EQ(v(5, 0), 0.5f);
}

TEST(PairSearch, NoLitRisesFromZeroToOneHalf) {
  const Floats v = Drawing({"#++++"}).visibility();
  for (int x = 1; x < 5; ++x)
    EXPECT_FLOAT_EQ(v(x, 0), static_cast<float>(x) / static_cast<float>(x + 4)) << x;
}

TEST(PairSearch, OnlyPenumbraIsOneHalf) {
  const Floats v = Drawing({"++", "++"}).visibility();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(v(i % 2, i / 2), 0.5f);
}

TEST(PairSearch, OnePixelSurfaces) {
  Drawing d({"#+.+"});
  for (int x = 0; x < 4; ++x) d.labels(x, 0) = static_cast<uint32_t>(x + 1);
  const Floats v = d.visibility();
  const float expected[] = {0, 0.5f, 1, 0.5f};
  for (int x = 0; x < 4; ++x) EXPECT_EQ(v(x, 0), expected[x]);
}

TEST(PairSearch, BoundKeepsOtherSurfacesOut) {
  Drawing d({"#++++."});
  d.labels(0, 0) = 2;
  const Floats bounded = d.visibility();
  EXPECT_FLOAT_EQ(bounded(1, 0), 0.5f) << "no umbra of its own: the deepest pixel";
  PairParams params;
  params.bound = SearchBound::none;
  EXPECT_FLOAT_EQ(d.visibility(params)(1, 0), 0.2f);
}

TEST(PairSearch, FramesEdgeIsNoSite) {
  const Floats v = Drawing({"++#", "++#"}).visibility();
  EXPECT_FLOAT_EQ(v(0, 0), 2.0f / 4.0f);
  EXPECT_FLOAT_EQ(v(1, 0), 1.0f / 3.0f);
}

TEST(PairSearch, Checkerboard) {
  const Floats v = Drawing({"#+.+", "+#+.", ".+#+"}).visibility();
  EXPECT_FLOAT_EQ(v(1, 1), 0.0f);
  EXPECT_FLOAT_EQ(v(1, 0), 0.5f) << "umbra and lit pixels at distance 1";
}

TEST(PairSearch, GridOfOneIsTheExactSearch) {
  const Bytes a = test::randomKinds(120, 90, 2, 0, 1), b = test::randomKinds(120, 90, 2, 0, 2);
  const Labels labels = test::randomLabels(120, 90, 9, 13, 3);
  const Floats exact = pairVisibility(a, b, labels, {});
  EXPECT_TRUE(equalBits<float>(exact, pairVisibility(a, b, labels, gridOf(1))));
  EXPECT_TRUE(equalBits<float>(exact, pairVisibility(a, b, labels, gridOf(1, true))));
}

TEST(PairSearch, GridInterpolatesByHand) {
  // Corners of the cell at columns 0 and 4: 0 (umbra) and 1 (lit); eq. 3.7 with Qx = x/4.
  const Drawing d({"#+++.", "#+++.", "#+++.", "#+++.", "#+++."});
  const Floats v = d.visibility(gridOf(4));
  for (int x = 1; x < 4; ++x) EXPECT_FLOAT_EQ(v(x, 2), static_cast<float>(x) / 4) << x;
}

TEST(PairSearch, GridKeepsToTheLabel) {
  Drawing d({"#+++.", "#+++.", "#+++.", "#+++.", "#+++."});
  for (int y = 0; y < 5; ++y) d.labels(4, y) = 2;
  const Floats v = d.visibility(gridOf(4));
  EXPECT_EQ(v(2, 2), 0.0f) << "only the umbra corners are of its label";
  for (int y = 0; y < 5; ++y) d.labels(0, y) = 3;
  EXPECT_EQ(d.visibility(gridOf(4))(2, 2), 0.5f) << "no corner left: searched itself";
}

TEST(PairSearch, AdaptiveGridIsCloserInNarrowPenumbrae) {
  const int size = 128;
  Bytes a(size, size, 1), b(size, size, 1);
  const Labels labels(size, size, 1);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const int width = 2 + y / 4;
      a(x, y) = x > 40;
      b(x, y) = x > 40 + width;
    }
  const Floats exact = pairVisibility(a, b, labels, {});
  const auto error = [&](const Floats& v) {
    double sum = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) sum += std::pow(v(x, y) - exact(x, y), 2);
    return std::sqrt(sum);
  };
  const double fixed = error(pairVisibility(a, b, labels, gridOf(16)));
  const double adaptive = error(pairVisibility(a, b, labels, gridOf(16, true)));
  EXPECT_LT(adaptive, 0.5 * fixed);
}

TEST(PairSearch, MirroredMasksGiveTheMirroredAnswer) {
  const Bytes a = test::randomKinds(131, 60, 2, 0, 5), b = test::randomKinds(131, 60, 2, 0, 6);
  const Labels labels = test::randomLabels(131, 60, 6, 17, 7);
  const Floats v = pairVisibility(a, b, labels, {});
  const Floats m = pairVisibility(test::mirrored<uint8_t>(a), test::mirrored<uint8_t>(b),
                                  test::mirrored<uint32_t>(labels), {});
  EXPECT_TRUE(equalBits<float>(test::mirrored<float>(v), m));
}

TEST(PairSearch, SameBitsForAnyNumberOfThreads) {
  const Bytes a = test::randomKinds(310, 200, 2, 100, 5), b = test::randomKinds(310, 200, 2, 90, 6);
  const Labels labels = test::randomLabels(310, 200, 30, 23, 7);
  for (const PairParams& params : {PairParams{}, gridOf(5), gridOf(9, true)}) {
    const Floats all = pairVisibility(a, b, labels, params);
    for (const size_t threads : {1, 2, 4}) {
      tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      EXPECT_TRUE(equalBits<float>(all, pairVisibility(a, b, labels, params)));
    }
  }
}

TEST(PairSearch, RefusesMasksOfOtherSizes) {
  const Bytes a(4, 4, 1), b(4, 3, 1);
  const Labels labels(4, 4, 1);
  EXPECT_THROW(pairVisibility(a, b, labels, {}), InputError);
}

}  // namespace
}  // namespace kagefude
