#include "passes/light_shape/light_shape.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <algorithm>

#include <cmath>

#include "base/error.h"
#include "passes/light_shape/disc_places.h"
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
struct LampFloor {
  int width, height;
  Labels labels;
  Vec3Plane position, normal;
  std::vector<Bytes> masks;
  LightGeometry geometry;

  template <class Lit>
  LampFloor(int w, int h, float shift, const Lit& lit)
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

  LightShapeResult resolve(const LightShapeParams& params = {},
                           const LightShapeWanted& wanted = {}) const {
    return lightShapeVisibility({std::vector<View<const uint8_t>>(masks.begin(), masks.end())},
                                disc9, labels, position, normal, geometry, params, wanted);
  }
};

double circleShare(double d) {
  d = std::clamp(d, -1.0, 1.0);
  return 0.5 + (d * std::sqrt(1 - d * d) + std::asin(d)) / M_PI;
}

TEST(LightShape, StraightEdgeHasTheDiscsOwnPenumbra) {
  const LampFloor floor(96, 64, 12, [](float x, float) { return x > 47.5f; });
  for (const bool follow : {false, true}) {
    LightShapeParams params;
    params.follow = follow;
    const LightShapeResult result = floor.resolve(params);
    for (int x = 0; x < 96; ++x)
      EXPECT_NEAR(result.visibility(x, 32), circleShare((x - 47.5) / 12), 0.04) << x << follow;
  }
}

TEST(LightShape, StripThinnerThanTheMasksSpacingIsFollowed) {
  const LampFloor floor(128, 96, 16, [](float x, float) { return std::fabs(x - 63.5f) > 2.0f; });
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
  const LampFloor floor(64, 48, 9, [](float x, float y) { return std::hypot(x - 30, y - 25) > 11; });
  for (const bool follow : {false, true}) {
    LightShapeParams params;
    params.lightSize = 0;
    params.follow = follow;
    const LightShapeResult result = floor.resolve(params);
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) EXPECT_EQ(result.visibility(x, y), floor.masks[0](x, y));
  }
}

TEST(LightShape, VisibilityIsTheSameWithNothingBesideIt) {
  const LampFloor floor(64, 48, 8, [](float x, float) { return x > 32; });
  const LightShapeResult told = floor.resolve(), untold = floor.resolve({}, {false, false});
  EXPECT_TRUE(untold.confidence.empty());
  EXPECT_TRUE(untold.unsure.empty());
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) ASSERT_EQ(untold.visibility(x, y), told.visibility(x, y));
}

TEST(LightShape, BackgroundIsLitAndSure) {
  LampFloor floor(32, 32, 5, [](float x, float) { return x > 16; });
  floor.labels.fill(0);
  const LightShapeResult result = floor.resolve();
  EXPECT_EQ(result.visibility(16, 16), 1.0f);
  EXPECT_EQ(result.confidence(16, 16), 1.0f);
}

TEST(LightShape, SurfaceOfOnePixelIsAShareOfItsMasksWithoutConfidence) {
  LampFloor floor(32, 32, 5, [](float x, float) { return x > 15.5f; });
  floor.labels(16, 16) = 2;
  const LightShapeResult result = floor.resolve();
  EXPECT_GT(result.visibility(16, 16), 0.2f);
  EXPECT_LT(result.visibility(16, 16), 0.8f);
  EXPECT_EQ(result.confidence(16, 16), 0.0f);
}

TEST(LightShape, ReceiverWithoutLitPixelStaysBetweenItsMasks) {
  // The label's pixels are hidden in every mask but one.
  LampFloor floor(24, 24, 0, [](float, float) { return false; });
  floor.masks[3].fill(1);
  const LightShapeResult result = floor.resolve();
  EXPECT_GT(result.visibility(12, 12), 0.0f);
  EXPECT_LT(result.visibility(12, 12), 0.3f);
  EXPECT_EQ(result.confidence(12, 12), 0.0f);
}

TEST(LightShape, ConfidenceFallsWhereTheFramesEdgeIsNearerThanTheShadows) {
  const LampFloor floor(64, 64, 14, [](float x, float) { return x > 31.5f; });
  const LightShapeResult result = floor.resolve();
  EXPECT_LT(result.confidence(26, 0), result.confidence(26, 32));
  EXPECT_EQ(result.confidence(26, 32), 1.0f);
}

TEST(LightShape, OccluderInFrontDoesNotCutTheShadow) {
  const auto lit = [](float x, float) { return x > 47.5f; };
  const LampFloor whole(96, 64, 12, lit);
  LampFloor cut(96, 64, 12, lit);
  for (int y = 0; y < 64; ++y)
    for (int x = 50; x < 54; ++x) cut.labels(x, y) = 7;
  const LightShapeResult a = whole.resolve(), b = cut.resolve();
  for (int x = 30; x < 70; ++x) {
    if (x >= 48 && x < 56) continue;
    EXPECT_NEAR(a.visibility(x, 32), b.visibility(x, 32), 0.1) << x;
  }
}

TEST(LightShape, GrowMovesTheEdge) {
  const LampFloor floor(96, 64, 6, [](float x, float) { return x > 47.5f; });
  LightShapeParams grown;
  grown.grow = 10;
  const LightShapeResult result = floor.resolve(grown);
  EXPECT_LT(result.visibility(52, 32), 0.05f);
  EXPECT_NEAR(result.visibility(57, 32), 0.5f, 0.06f);
}

TEST(LightShape, TooFewMasksSayWhatToExport) {
  const LampFloor floor(16, 16, 2, [](float x, float) { return x > 8; });
  const std::vector<View<const uint8_t>> masks(floor.masks.begin(), floor.masks.begin() + 3);
  try {
    lightShapeVisibility(masks, {disc9.data(), 3}, floor.labels, {}, {}, std::nullopt, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--masks disc:9"), std::string::npos) << error.what();
  }
}

TEST(LightShape, MasksOfOtherSizesAreRefused) {
  LampFloor floor(16, 16, 2, [](float x, float) { return x > 8; });
  floor.masks[4] = Bytes(15, 16, uint8_t{1});
  EXPECT_THROW(floor.resolve(), InputError);
}

TEST(LightShape, SameBitsForAnyNumberOfThreads) {
  const LampFloor floor(90, 70, 9, [](float x, float y) {
    return std::hypot(x - 40, y - 30) > 9 && std::fabs(x + y - 90) > 1.5f;
  });
  const LightShapeResult many = floor.resolve();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LightShapeResult single = floor.resolve();
  EXPECT_TRUE(test::equalBits<float>(many.visibility, single.visibility));
  EXPECT_TRUE(test::equalBits<float>(many.confidence, single.confidence));
}

TEST(LightShape, ReceiverWithoutUmbraPixelStaysBetweenItsMasks) {
  // The label's pixels are lit in every mask but two: nothing is dark in all of them.
  LampFloor floor(24, 24, 0, [](float, float) { return true; });
  floor.masks[2].fill(0);
  floor.masks[6].fill(0);
  const LightShapeResult result = floor.resolve();
  EXPECT_GT(result.visibility(12, 12), 0.6f);
  EXPECT_LT(result.visibility(12, 12), 1.0f);
  EXPECT_EQ(result.confidence(12, 12), 0.0f);
}

TEST(LightShape, FramesEdgeIsNoShadowsEdge) {
  // The same shadow with the frame cut off beside it: what is left does not change where the edge
  // is nearer than the frame's.
  const auto lit = [](float x, float) { return x > 47.5f; };
  const LampFloor whole(96, 64, 8, lit), cut(60, 64, 8, lit);
  const LightShapeResult a = whole.resolve(), b = cut.resolve();
  for (int x = 36; x < 60; ++x) EXPECT_NEAR(a.visibility(x, 32), b.visibility(x, 32), 0.02) << x;
}

TEST(LightShape, SoftenWidensTheLight) {
  // Softened by one radius, the penumbra of a straight edge is that of a light twice as large.
  const LampFloor floor(128, 64, 8, [](float x, float) { return x > 63.5f; });
  LightShapeParams soft;
  soft.soften = 1;
  const LightShapeResult result = floor.resolve(soft);
  for (int x = 40; x < 88; ++x)
    EXPECT_NEAR(result.visibility(x, 32), circleShare((x - 63.5) / 16), 0.06) << x;
}

TEST(LightShape, AbstractSmoothsContoursAndKeepsStraightOnes) {
  const auto saw = [](float x, float y) {
    return x > 47.5f + 4.0f * std::fabs(std::remainder(y, 8.0f)) - 8.0f;
  };
  const auto edgeAt = [](const LightShapeResult& r, int y) {
    double sum = 0;
    for (int x = 24; x < 72; ++x) sum += r.visibility(x, y);
    return 72 - sum;
  };
  LightShapeParams abstract, plain;
  abstract.abstract = 6;
  plain.follow = false;
  const LampFloor toothed(96, 64, 3, saw);
  const LightShapeResult a = toothed.resolve(abstract), p = toothed.resolve(plain);
  double low = 1e9, high = 0, plainLow = 1e9, plainHigh = 0;
  for (int y = 24; y < 40; ++y) {
    low = std::min(low, edgeAt(a, y)), high = std::max(high, edgeAt(a, y));
    plainLow = std::min(plainLow, edgeAt(p, y)), plainHigh = std::max(plainHigh, edgeAt(p, y));
  }
  EXPECT_GT(plainHigh - plainLow, 4.0) << "teeth";
  EXPECT_LT(high - low, 0.5 * (plainHigh - plainLow));
  const LampFloor straight(96, 64, 6, [](float x, float) { return x > 47.5f; });
  EXPECT_NEAR(edgeAt(straight.resolve(abstract), 32), edgeAt(straight.resolve(plain), 32), 0.2);
}

TEST(LightShape, GrowAndShrinkMoveTheEdgeByPixels) {
  const LampFloor floor(96, 64, 6, [](float x, float) { return x > 47.5f; });
  for (const float grow : {-9.0f, 4.0f}) {
    LightShapeParams params;
    params.grow = grow;
    const LightShapeResult result = floor.resolve(params);
    for (int x = 20; x < 80; ++x)
      EXPECT_NEAR(result.visibility(x, 32), circleShare((x - 47.5 - grow) / 6.0), 0.06) << x;
  }
}

TEST(LightShape, LineOfMasksIsEvenAlongItAndShrinksWithItsSize) {
  // A tube light along x: the penumbra of a straight edge rises evenly over its length.
  constexpr int width = 96, height = 16;
  const Labels labels(width, height, 1u);
  std::vector<V2f> places;
  std::vector<Bytes> masks;
  for (const float u : {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f}) {
    places.emplace_back(u, 0.0f);
    Bytes& mask = masks.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) mask(x, y) = static_cast<float>(x) + 12 * u > 47.5f;
  }
  const std::vector<View<const uint8_t>> views(masks.begin(), masks.end());
  for (const float size : {1.0f, 0.5f, 0.0f}) {
    LightShapeParams params;
    params.lightSize = size;
    const LightShapeResult result =
        lightShapeVisibility(views, places, labels, {}, {}, std::nullopt, params);
    for (int x = 20; x < 76; ++x) {
      const float away = static_cast<float>(x) - 47.5f;
      const float exact = size > 0 ? std::clamp(0.5f + away / (24 * size), 0.0f, 1.0f)
                                   : static_cast<float>(away > 0);
      EXPECT_NEAR(result.visibility(x, 8), exact, 0.03f) << x << " " << size;
    }
  }
}

TEST(LightShape, SeventeenMasksSeeWhatFallsBetweenNine) {
  // A dot smaller than the gaps of nine masks, unfollowed, against the share of the disc it covers.
  const std::vector<V2f> places = discPlaces(17);
  const auto error = [&](size_t count) {
    constexpr int size = 96;
    std::vector<Bytes> masks;
    for (size_t k = 0; k < count; ++k) {
      Bytes& mask = masks.emplace_back(size, size);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
          mask(x, y) = std::hypot(static_cast<float>(x) + 20 * places[k].x - 47.5f,
                                  static_cast<float>(y) + 20 * places[k].y - 47.5f) > 6.0f;
    }
    const std::vector<View<const uint8_t>> views(masks.begin(), masks.end());
    const LightShapeResult result = lightShapeVisibility(
        views, {places.data(), count}, Labels(size, size, 1u), {}, {}, std::nullopt, {});
    double sum = 0;
    for (int y = 30; y < 66; ++y)
      for (int x = 30; x < 66; ++x)
        if (std::hypot(x - 47.5, y - 47.5) < 13)
          sum += std::pow(result.visibility(x, y) - (1.0 - 36.0 / 400.0), 2);
    return std::sqrt(sum);
  };
  EXPECT_LT(error(17), 0.7 * error(9));
}

}  // namespace
}  // namespace kagefude
