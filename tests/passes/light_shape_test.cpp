#include "passes/light_shape.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/error.h"
#include "passes/mask_distance.h"
#include "passes/random_image.h"

namespace kagefude {
namespace {

const std::vector<V2f> disc9 = [] {
  std::vector<V2f> places{{0, 0}};
  for (int i = 0; i < 8; ++i)
    places.emplace_back(static_cast<float>(std::cos(i * M_PI / 4)),
                        static_cast<float>(std::sin(i * M_PI / 4)));
  return places;
}();

/// A floor seen from above, one unit a pixel, under a light of radius 1 at a height of 100; a
/// blocker whose shadow shifts by `shift` pixels against each unit of place.
struct Floor {
  int width, height;
  Labels labels;
  Vec3Plane position, normal;
  std::vector<Bytes> masks;
  LightGeometry geometry;

  template <class Lit>
  Floor(int w, int h, float shift, const Lit& lit)
      : width(w), height(h), labels(w, h, 1u), position(w, h), normal(w, h) {
    geometry.position = V3f(static_cast<float>(w) / 2, static_cast<float>(h) / 2, 100);
    geometry.u = V3f(1, 0, 0);
    geometry.v = V3f(0, 1, 0);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        position.set(x, y, V3f(static_cast<float>(x), static_cast<float>(y), 0));
        normal.set(x, y, V3f(0, 0, 1));
      }
    for (const V2f& p : disc9) {
      Bytes& mask = masks.emplace_back(w, h);
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
          mask(x, y) =
              lit(static_cast<float>(x) + shift * p.x, static_cast<float>(y) + shift * p.y);
    }
  }

  LightShapeResult resolve(const LightShapeParams& params = {}) const {
    return lightShapeVisibility({std::vector<View<const uint8_t>>(masks.begin(), masks.end())},
                                disc9, labels, position, normal, geometry, params);
  }
};

double circleShare(double d) {
  d = std::clamp(d, -1.0, 1.0);
  return 0.5 + (d * std::sqrt(1 - d * d) + std::asin(d)) / M_PI;
}

TEST(LightShape, StraightEdgeHasTheDiscsOwnPenumbra) {
  const Floor floor(96, 64, 12, [](float x, float) { return x > 47.5f; });
  for (const bool follow : {false, true}) {
    LightShapeParams params;
    params.follow = follow;
    const LightShapeResult result = floor.resolve(params);
    for (int x = 0; x < 96; ++x)
      EXPECT_NEAR(result.visibility(x, 32), circleShare((x - 47.5) / 12), 0.04) << x << follow;
  }
}

TEST(LightShape, StripThinnerThanTheMasksSpacingIsFollowed) {
  const Floor floor(128, 96, 16, [](float x, float) { return std::fabs(x - 63.5f) > 2.0f; });
  LightShapeParams without;
  without.follow = false;
  const LightShapeResult followed = floor.resolve(), plain = floor.resolve(without);
  double followedError = 0, plainError = 0;
  for (int x = 40; x < 88; ++x) {
    const double truth = 1 - circleShare((x - 61.5) / 16) + circleShare((x - 65.5) / 16);
    followedError += std::pow(followed.visibility(x, 48) - truth, 2);
    plainError += std::pow(plain.visibility(x, 48) - truth, 2);
  }
  EXPECT_LT(std::sqrt(followedError / 48), 0.04);
  EXPECT_LT(followedError, 0.5 * plainError);
}

TEST(LightShape, LightSizeZeroIsTheHardCentreMask) {
  const Floor floor(64, 48, 9, [](float x, float y) { return std::hypot(x - 30, y - 25) > 11; });
  for (const bool follow : {false, true}) {
    LightShapeParams params;
    params.lightSize = 0;
    params.follow = follow;
    const LightShapeResult result = floor.resolve(params);
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) EXPECT_EQ(result.visibility(x, y), floor.masks[0](x, y));
  }
}

TEST(LightShape, BackgroundIsLitAndSure) {
  Floor floor(32, 32, 5, [](float x, float) { return x > 16; });
  floor.labels.fill(0);
  const LightShapeResult result = floor.resolve();
  EXPECT_EQ(result.visibility(16, 16), 1.0f);
  EXPECT_EQ(result.confidence(16, 16), 1.0f);
}

TEST(LightShape, SurfaceOfOnePixelIsAShareOfItsMasksWithoutConfidence) {
  Floor floor(32, 32, 5, [](float x, float) { return x > 15.5f; });
  floor.labels(16, 16) = 2;
  const LightShapeResult result = floor.resolve();
  EXPECT_GT(result.visibility(16, 16), 0.2f);
  EXPECT_LT(result.visibility(16, 16), 0.8f);
  EXPECT_EQ(result.confidence(16, 16), 0.0f);
}

TEST(LightShape, ReceiverWithoutLitPixelStaysBetweenItsMasks) {
  // The label's pixels are hidden in every mask but one.
  Floor floor(24, 24, 0, [](float, float) { return false; });
  floor.masks[3].fill(1);
  const LightShapeResult result = floor.resolve();
  EXPECT_GT(result.visibility(12, 12), 0.0f);
  EXPECT_LT(result.visibility(12, 12), 0.3f);
  EXPECT_EQ(result.confidence(12, 12), 0.0f);
}

TEST(LightShape, ConfidenceFallsWhereTheFramesEdgeIsNearerThanTheShadows) {
  const Floor floor(64, 64, 14, [](float x, float) { return x > 31.5f; });
  const LightShapeResult result = floor.resolve();
  EXPECT_LT(result.confidence(26, 0), result.confidence(26, 32));
  EXPECT_EQ(result.confidence(26, 32), 1.0f);
}

TEST(LightShape, OccluderInFrontDoesNotCutTheShadow) {
  const auto lit = [](float x, float) { return x > 47.5f; };
  const Floor whole(96, 64, 12, lit);
  Floor cut(96, 64, 12, lit);
  for (int y = 0; y < 64; ++y)
    for (int x = 50; x < 54; ++x) cut.labels(x, y) = 7;
  const LightShapeResult a = whole.resolve(), b = cut.resolve();
  for (int x = 30; x < 70; ++x) {
    if (x >= 48 && x < 56) continue;
    EXPECT_NEAR(a.visibility(x, 32), b.visibility(x, 32), 0.1) << x;
  }
}

TEST(LightShape, GrowMovesTheEdge) {
  const Floor floor(96, 64, 6, [](float x, float) { return x > 47.5f; });
  LightShapeParams grown;
  grown.grow = 10;
  const LightShapeResult result = floor.resolve(grown);
  EXPECT_LT(result.visibility(52, 32), 0.05f);
  EXPECT_NEAR(result.visibility(57, 32), 0.5f, 0.06f);
}

TEST(LightShape, TooFewMasksSayWhatToExport) {
  const Floor floor(16, 16, 2, [](float x, float) { return x > 8; });
  const std::vector<View<const uint8_t>> masks(floor.masks.begin(), floor.masks.begin() + 3);
  try {
    lightShapeVisibility(masks, {disc9.data(), 3}, floor.labels, {}, {}, std::nullopt, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--masks disc:9"), std::string::npos) << error.what();
  }
}

TEST(LightShape, MasksOfOtherSizesAreRefused) {
  Floor floor(16, 16, 2, [](float x, float) { return x > 8; });
  floor.masks[4] = Bytes(15, 16, uint8_t{1});
  EXPECT_THROW(floor.resolve(), InputError);
}

TEST(LightShape, SameBitsForAnyNumberOfThreads) {
  const Floor floor(90, 70, 9, [](float x, float y) {
    return std::hypot(x - 40, y - 30) > 9 && std::fabs(x + y - 90) > 1.5f;
  });
  const LightShapeResult many = floor.resolve();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LightShapeResult single = floor.resolve();
  EXPECT_TRUE(test::equalBits<float>(many.visibility, single.visibility));
  EXPECT_TRUE(test::equalBits<float>(many.confidence, single.confidence));
}

TEST(MaskDistance, EqualsTheNaiveSearchWithinLabels) {
  constexpr int size = 24;
  Bytes mask(size, size), kinds(size, size);
  Labels labels(size, size);
  std::mt19937 random(5);
  for (int i = 0; i < size * size; ++i) {
    mask.view().data[i] = random() % 5 != 0;
    labels.view().data[i] = random() % 3;
  }
  for (int i = 0; i < size * size; ++i) kinds.view().data[i] = labels.view().data[i] != 0;
  const PixelSet wanted(kinds, 1, 1);
  const std::vector<View<const uint8_t>> masks{mask};
  const Distances found = maskDistances(masks, wanted, labels);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (labels(x, y) == 0) continue;
      double nearest = 1e9;
      for (int v = 0; v < size; ++v)
        for (int u = 0; u < size; ++u)
          if (labels(u, v) == labels(x, y) && mask(u, v) != mask(x, y))
            nearest = std::min(nearest, std::hypot(u - x, v - y));
      const double sign = mask(x, y) ? 1 : -1;
      EXPECT_NEAR(found(static_cast<int>(wanted.indexOf(x, y)), 0) * distanceUnit, sign * (nearest - 0.5), 1.0 / 16);
    }
}

}  // namespace
}  // namespace kagefude
