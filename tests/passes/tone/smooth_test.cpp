#include "passes/tone/smooth.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdlib>

#include "base/error.h"
#include "passes/random_image.h"

namespace kagefude {
namespace {

using test::equalBits;
using test::randomFloats;
using test::randomLabels;

Floats naive(const Floats& value, const Labels& labels, int h) {
  Floats result(value.width(), value.height());
  for (int y = 0; y < value.height(); ++y)
    for (int x = 0; x < value.width(); ++x) {
      double sum = 0;
      int count = 0;
      for (int v = y - h; v <= y + h; ++v)
        for (int u = x - h; u <= x + h; ++u)
          if (labels.view().contains(u, v) && labels(u, v) == labels(x, y)) {
            sum += value(u, v);
            ++count;
          }
      result(x, y) = labels(x, y) == 0 ? value(x, y) : static_cast<float>(sum / count);
    }
  return result;
}

TEST(Smooth, MeanByHand) {
  // 4.4-4.7: centre label 1, window 3x3 with labels 1 at five places.
  Floats value(3, 3, 100.0f);
  Labels labels(3, 3, 2);
  const int own[][2] = {{1, 1}, {0, 0}, {2, 0}, {0, 2}, {2, 2}};
  float next = 1;
  for (const auto& [x, y] : own) {
    value(x, y) = next++;
    labels(x, y) = 1;
  }
  SmoothParams params;
  params.h = 1;
  EXPECT_FLOAT_EQ(smoothWithinSurfaces(value, labels, params)(1, 1), 3.0f);
}

TEST(Smooth, WhatIsNothingFarAroundStaysNothingAndWhatReachesOverATileCounts) {
  // One value beside the corner where four tiles meet; its window reaches into all of them.
  constexpr int side = 400, at = 129, h = 3;
  Floats value(side, side, 0.0f);
  value(at, at) = 49.0f;
  const Labels labels(side, side, 1);
  const Floats means = smoothWithinSurfaces(value, labels, SmoothParams{h});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const bool near = std::abs(x - at) <= h && std::abs(y - at) <= h;
      ASSERT_EQ(means(x, y), near ? 1.0f : 0.0f) << x << " " << y;
    }
}

TEST(Smooth, EqualsTheNaiveMeanWithinTheBound) {
  uint32_t seed = 0;
  for (const int count : {1, 3, 60, 4000})
    for (const int cell : {1, 9, 50})
      for (const int h : {0, 1, 2, 7, 40}) {
        if (h == 40 && cell != 9) continue;  // the naive mean is slow there
        const Floats value = randomFloats(161, 139, ++seed);
        Labels labels = randomLabels(161, 139, count, cell, ++seed);
        if (count == 1) labels.fill(7);
        SmoothParams params;
        params.h = h;
        const Floats fast = smoothWithinSurfaces(value, labels, params);
        const Floats slow = naive(value, labels, h);
        float worst = 0;
        for (size_t i = 0; i < value.view().pixels(); ++i)
          worst = std::max(worst, std::abs(fast.view().data[i] - slow.view().data[i]));
        ASSERT_LE(worst, 2e-6f) << count << " labels, cell " << cell << ", h " << h;
      }
}

TEST(Smooth, AFlatPictureStaysFlat) {
  const Floats value(200, 150, 0.25f);
  const Floats result = smoothWithinSurfaces(value, randomLabels(200, 150, 30, 8, 2), {});
  EXPECT_TRUE(equalBits<float>(result, value));
}

TEST(Smooth, BackgroundAndOnePixelSurfacesPassThrough) {
  const Floats value = randomFloats(3, 1, 5);
  Labels labels(3, 1, 0);
  labels(1, 0) = 8;
  EXPECT_TRUE(equalBits<float>(smoothWithinSurfaces(value, labels, {}), value));
}

TEST(Smooth, SameBitsForAnyNumberOfThreads) {
  const Floats value = randomFloats(300, 280, 1);
  for (const int count : {5, 5000}) {
    const Labels labels = randomLabels(300, 280, count, count > 5 ? 1 : 30, 2);
    SmoothParams params;
    params.h = 5;
    const Floats all = smoothWithinSurfaces(value, labels, params);
    for (const size_t threads : {1, 2, 4}) {
      tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      EXPECT_TRUE(equalBits<float>(all, smoothWithinSurfaces(value, labels, params)));
    }
  }
}

TEST(Smooth, RefusesPlanesOfOtherSizes) {
  EXPECT_THROW(smoothWithinSurfaces(Floats(3, 3, 0.0f), Labels(3, 2, 1), {}), InputError);
}

}  // namespace
}  // namespace kagefude
