#include "passes/light_shape/mask_distance.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/error.h"
#include "passes/random_image.h"

namespace kagefude {
namespace {

PixelSet everywhere(View<const uint32_t> labels) {
  Bytes kinds(labels.width, labels.height);
  for (size_t i = 0; i < labels.pixels(); ++i) kinds.view().data[i] = labels.data[i] != 0;
  return PixelSet(kinds, 1, 1);
}

/// In sixteenths, by looking at every pixel.
int naive(View<const uint8_t> mask, View<const uint32_t> labels, int x, int y) {
  double nearest = 1e9;
  for (int v = 0; v < mask.height; ++v)
    for (int u = 0; u < mask.width; ++u)
      if (labels(u, v) == labels(x, y) && (mask(u, v) != 0) != (mask(x, y) != 0))
        nearest = std::min(nearest, std::hypot(u - x, v - y));
  const bool lit = mask(x, y) != 0;
  if (nearest > 2000) return lit ? farLit : farDark;
  return static_cast<int>((lit ? 1 : -1) * std::floor(16 * (nearest - 0.5) + 0.5));
}

void expectNaive(View<const uint8_t> mask, View<const uint32_t> labels, int stride = 1) {
  const PixelSet wanted = everywhere(labels);
  const View<const uint8_t> masks[] = {mask};
  const Distances found = maskDistances(masks, wanted, labels);
  int differ = 0;
  for (int y = 0; y < mask.height; y += stride)
    for (int x = 0; x < mask.width; x += stride)
      if (labels(x, y) != 0)
        differ += found(static_cast<int>(wanted.indexOf(x, y)), 0) != naive(mask, labels, x, y);
  EXPECT_EQ(differ, 0);
}

TEST(MaskDistance, EqualsTheNaiveSearchWithinLabels) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const Labels labels = test::randomLabels(97, 61, 4, 11, seed);
    expectNaive(test::randomKinds(97, 61, 2, 60, seed + 9), labels);
  }
}

TEST(MaskDistance, ManyTinyLabelsGoByListsAndAreEqual) {
  const Labels labels = test::randomLabels(120, 90, 400, 4, 5);
  expectNaive(test::randomKinds(120, 90, 2, 0, 6), labels);
}

TEST(MaskDistance, FarSitesInWideRowsAreExact) {
  // Beyond the reach of the block search, so by the envelope.
  Bytes mask(700, 40, uint8_t{1});
  mask(3, 20) = mask(690, 2) = 0;
  expectNaive(mask, Labels(700, 40, 1u), 3);
}

TEST(MaskDistance, LabelLargerThanOneTaskIsExact) {
  Bytes mask(1400, 800, uint8_t{1});
  for (int i = 0; i < 6; ++i) mask(200 + 190 * i, 100 + 110 * i) = 0;
  const Labels labels(1400, 800, 1u);
  const PixelSet wanted = everywhere(labels);
  const View<const uint8_t> masks[] = {mask};
  const Distances found = maskDistances(masks, wanted, labels);
  for (int y = 0; y < 800; y += 37)
    for (int x = 0; x < 1400; x += 41) {
      double nearest = 1e9;
      for (int i = 0; i < 6; ++i)
        nearest = std::min(nearest, std::hypot(200 + 190 * i - x, 100 + 110 * i - y));
      if (nearest == 0) continue;
      EXPECT_NEAR(found(static_cast<int>(wanted.indexOf(x, y)), 0) * distanceUnit, nearest - 0.5,
                  distanceUnit);
    }
}

TEST(MaskDistance, LabelWithoutTheOtherKindIsFar) {
  Bytes mask(40, 30, uint8_t{1});
  Labels labels(40, 30, 1u);
  for (int x = 20; x < 40; ++x)
    for (int y = 0; y < 30; ++y) labels(x, y) = 2, mask(x, y) = 0;
  const PixelSet wanted = everywhere(labels);
  const View<const uint8_t> masks[] = {mask};
  const Distances found = maskDistances(masks, wanted, labels);
  EXPECT_EQ(found(static_cast<int>(wanted.indexOf(5, 5)), 0), farLit);
  EXPECT_EQ(found(static_cast<int>(wanted.indexOf(35, 5)), 0), farDark);
}

TEST(MaskDistance, SurfaceOfOnePixelIsFar) {
  Labels labels(9, 9, 1u);
  labels(4, 4) = 2;
  const PixelSet wanted = everywhere(labels);
  const Bytes mask = test::randomKinds(9, 9, 2, 0, 3);
  const View<const uint8_t> masks[] = {mask};
  const Distances found = maskDistances(masks, wanted, labels);
  EXPECT_EQ(found(static_cast<int>(wanted.indexOf(4, 4)), 0), mask(4, 4) ? farLit : farDark);
}

TEST(MaskDistance, NoWantedPixelGivesNothing) {
  const Labels labels(8, 8, 0u);
  const Bytes mask(8, 8, uint8_t{1});
  const View<const uint8_t> masks[] = {mask, mask};
  EXPECT_EQ(maskDistances(masks, everywhere(labels), labels).width(), 0);
}

TEST(MaskDistance, SameBitsForAnyNumberOfThreads) {
  const Labels labels = test::randomLabels(310, 200, 30, 23, 7);
  const Bytes a = test::randomKinds(310, 200, 2, 90, 5), b = test::randomKinds(310, 200, 2, 50, 6);
  const View<const uint8_t> masks[] = {a, b};
  const PixelSet wanted = everywhere(labels);
  const Distances all = maskDistances(masks, wanted, labels);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(test::equalBits<int16_t>(all, maskDistances(masks, wanted, labels)));
}

TEST(MaskDistance, RefusesMasksOfOtherSizes) {
  const Labels labels(8, 8, 1u);
  const Bytes mask(8, 7, uint8_t{1});
  const View<const uint8_t> masks[] = {mask};
  EXPECT_THROW(maskDistances(masks, everywhere(labels), labels), InputError);
}

}  // namespace
}  // namespace kagefude
