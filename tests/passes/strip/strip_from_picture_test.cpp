#include "passes/strip/strip_from_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "image/oklab.h"
#include "passes/strip/strip_check.h"
#include "passes/strip/stroke_noise.h"

namespace kagefude {
namespace {

/// A painting of two colours, dark blue to light orange from left to right, with strokes of 4 x 40
/// pixels along x, or along y.
struct Painting {
  Floats r, g, b;
  explicit Painting(int width, int height, bool down = false)
      : r(width, height), g(width, height), b(width, height) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float fx = static_cast<float>(x), fy = static_cast<float>(y);
        const float stroke =
            down ? strokeNoise(3, fx / 4, fy / 40) : strokeNoise(3, fx / 40, fy / 4);
        const float t = fx / static_cast<float>(width) + 0.25f * (stroke - 0.5f);
        r(x, y) = 0.1f + 0.8f * t;
        g(x, y) = 0.1f + 0.6f * t;
        b(x, y) = 0.4f - 0.1f * t;
      }
  }
  PaintedStrip strip(int size = 128) const {
    FromPictureParams params;
    params.width = params.height = size;
    return stripFromPicture(r, g, b, params);
  }
};

double roughness(const Floats& plane, int dx, int dy) {
  double sum = 0;
  for (int y = 0; y + dy < plane.height(); ++y)
    for (int x = 0; x + dx < plane.width(); ++x)
      sum += std::fabs(plane(x + dx, y + dy) - plane(x, y));
  return sum;
}

TEST(StripFromPicture, IsReadyToPaintWith) {
  const PaintedStrip strip = Painting(300, 200).strip(256);
  const StripReport report = checkStrip(strip.r, strip.g, strip.b);
  EXPECT_TRUE(report.problems.empty()) << report.problems.front();
  EXPECT_LT(report.seamRatio, 1.5f);
  EXPECT_LT(report.disorder, 0.02f);
}

TEST(StripFromPicture, TonesAreThePictures) {
  const PaintedStrip strip = Painting(300, 200).strip();
  // The darkest and the brightest percent of the picture: blue below, orange above.
  EXPECT_GT(strip.b(5, 125), strip.r(5, 125) + 0.1f);
  EXPECT_GT(strip.r(5, 2), strip.b(5, 2) + 0.3f);
  // A third of the way up stands the colour of that lightness in the picture.
  double r = 0, b = 0, g = 0;
  for (int x = 0; x < 128; ++x) {
    r += strip.r(x, 85) / 128.0;
    g += strip.g(x, 85) / 128.0;
    b += strip.b(x, 85) / 128.0;
  }
  const double t = (r - 0.1) / 0.8;
  EXPECT_NEAR(g, 0.1 + 0.6 * t, 0.03);
  EXPECT_NEAR(b, 0.4 - 0.1 * t, 0.03);
}

TEST(StripFromPicture, StrokesRunAlongTheRowHoweverTheyRan) {
  for (const bool down : {false, true}) {
    const PaintedStrip strip = Painting(300, 300, down).strip();
    EXPECT_GT(roughness(strip.g, 0, 1), 2 * roughness(strip.g, 1, 0)) << down;
  }
}

TEST(StripFromPicture, RefusesWhatGivesNoStrip) {
  EXPECT_THROW(Painting(15, 40).strip(), InputError);
  Floats flat(64, 64, 0.5f);
  EXPECT_THROW(stripFromPicture(flat, flat, flat, {}), InputError);
}

TEST(StripFromPicture, BrokenTexelsAreBlack) {
  Painting painting(64, 64);
  painting.r(3, 3) = NAN;
  painting.g(4, 4) = INFINITY;
  const PaintedStrip strip = painting.strip(64);
  for (int i = 0; i < 64 * 64; ++i) ASSERT_TRUE(std::isfinite(strip.r.row(0)[i]));
}

}  // namespace
}  // namespace kagefude
