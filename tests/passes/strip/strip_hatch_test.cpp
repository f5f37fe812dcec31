#include "passes/strip/strip_hatch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/oklab.h"
#include "passes/strip/strip.h"

namespace kagefude {
namespace {

StripPaintParams penLines(int sets) {
  StripPaintParams params;
  params.hatch = sets;
  params.strokeWidth = 16;
  params.wobble = 0.4f;
  params.pressure = 0.0f;
  params.ink = {0, 0, 0};
  params.stops = {0, 0, 0, 0, 1, 1, 1, 1};
  return params;
}

TEST(StripHatch, SharesOfInkByHand) {
  // One set: the distance itself. Two: the second set's lines begin at 0.45 of ink; off both lines'
  // reach is 1.
  EXPECT_FLOAT_EQ(hatchShare(0.3f, 0.0f, 1), 0.3f);
  EXPECT_FLOAT_EQ(hatchShare(0.2f, 1.0f, 2), 0.2f);
  EXPECT_NEAR(hatchShare(1.0f, 0.0f, 2), 0.45f, 1e-6f);
  EXPECT_NEAR(hatchShare(0.8f, 1.0f, 2), 1.0f, 1e-6f);
  EXPECT_FLOAT_EQ(hatchShare(1.0f, 1.0f, 2), 1.0f);
}

TEST(StripHatch, CoversWhatItsNumberSays) {
  // Over even and independent distances {h < c} has the area c.
  for (const float c : {0.2f, 0.45f, 0.6f, 0.9f}) {
    int covered = 0;
    for (int i = 0; i < 500; ++i)
      for (int j = 0; j < 500; ++j)
        covered += hatchShare((static_cast<float>(i) + 0.5f) / 500.0f,
                              (static_cast<float>(j) + 0.5f) / 500.0f, 2) < c;
    EXPECT_NEAR(covered / 250000.0, c, 0.005) << c;
  }
}

TEST(StripHatch, ARowsMeanIsItsTone) {
  const PaintedStrip strip = hatchStrip(penLines(2));
  for (int y = 20; y < 500; y += 60) {
    double mean = 0;
    for (int x = 0; x < 512; ++x) mean += strip.g(x, y) / 512.0;
    EXPECT_NEAR(mean, 1.0 - (y + 0.5) / 512.0, 0.06) << y;
  }
}

TEST(StripHatch, LinesStayWhileTheToneChanges) {
  // Of a strip of lines the grain is the field of shares itself, in every row: what is darkest in
  // one row (a line's middle) is darkest a few rows on.
  PaintedStrip painted = hatchStrip(penLines(1));
  for (Floats* plane : {&painted.r, &painted.g, &painted.b})
    for (int i = 0; i < 512 * 512; ++i) plane->row(0)[i] = linearOfSrgb(plane->row(0)[i]);
  const Strip strip = makeStrip(painted.r, painted.g, painted.b);
  const StripGrain::Level& level = strip.grain.levels.front();
  ASSERT_GT(level.height, 400) << "rows of lines count as strokes";
  const auto at = [&](int x, int y) {
    const uint32_t four = strip.grain.pool.row(0)[grainTexel(x, y, level.tilesAcross())];
    return static_cast<double>(four & 255u) - 128.0;
  };
  for (int y = 40; y + 8 < level.height; y += 50) {
    double product = 0, a = 0, b = 0, extremes = 0;
    for (int x = 0; x < level.width; ++x) {
      product += at(x, y) * at(x, y + 4);
      a += at(x, y) * at(x, y);
      b += at(x, y + 4) * at(x, y + 4);
      extremes += std::fabs(std::fabs(at(x, y)) - 36.3) < 4.0;
    }
    EXPECT_GT(product / std::sqrt(a * b), 0.8) << y;
    // An even spread from -63 to 63 (variance 1 is 36.3 steps), not two values.
    EXPECT_LT(extremes / level.width, 0.3) << y;
  }
}

}  // namespace
}  // namespace kagefude
