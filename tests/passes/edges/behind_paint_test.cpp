#include "passes/edges/behind_paint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace kagefude {
namespace {

constexpr int side = 15;
constexpr float thingRed = 0.9f, thingGreen = 0.35f;  // as rendered
constexpr float paintRed = 0.05f, paintGreen = 0.6f;  // as painted

// A thing before a sky, rendered and painted, both by the same coverage.
struct Silhouette {
  Labels id{side, side, 7u};
  Floats coverage{side, side};
  Floats r{side, side}, g{side, side}, b{side, side}, a{side, side};
  Floats paintR{side, side}, paintG{side, side}, paintB{side, side, 0.0f}, paintA{side, side};
  std::function<float(int, int)> sky = [](int, int) { return 0.25f; };
  float skyAlpha = 1.0f;

  explicit Silhouette(const std::function<float(int, int)>& covered) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) coverage(x, y) = covered(x, y);
  }
  void lay() {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float c = coverage(x, y), behind = (1 - c) * sky(x, y);
        r(x, y) = c * thingRed + behind;
        g(x, y) = c * thingGreen + behind;
        b(x, y) = behind;
        a(x, y) = c + (1 - c) * skyAlpha;
        paintR(x, y) = c * paintRed;
        paintG(x, y) = c * paintGreen;
        paintA(x, y) = c;
      }
    const CoverageRank ranks[] = {{id, coverage}};
    layOverPicture({paintR.view(), paintG.view(), paintB.view(), paintA.view()}, {r, g, b, a},
                   ranks);
  }
  // The greatest distance from paint and sky mixed by coverage.
  float worst() const {
    float worst = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float c = coverage(x, y), behind = (1 - c) * sky(x, y);
        worst = std::max({worst, std::fabs(paintR(x, y) - (c * paintRed + behind)),
                          std::fabs(paintG(x, y) - (c * paintGreen + behind)),
                          std::fabs(paintB(x, y) - behind),
                          std::fabs(paintA(x, y) - (c + (1 - c) * skyAlpha))});
      }
    return worst;
  }
};

// Area of the pixel's square on the near side of a slanted line, by a fine grid.
float underLine(int x, int y, float slope, float start) {
  int inside = 0;
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 16; ++u)
      inside += y + (v + 0.5f) / 16 > start + slope * (x + (u + 0.5f) / 16);
  return static_cast<float>(inside) / 256;
}

TEST(BehindPaint, NoRimBeforeOneColourAtAnySlope) {
  for (const float slope : {-2.0f, -0.7f, 0.0f, 0.1f, 0.33f, 1.0f, 3.0f}) {
    Silhouette edge([&](int x, int y) { return underLine(x, y, slope, 7.3f - 7 * slope); });
    edge.lay();
    EXPECT_LT(edge.worst(), 1e-6f) << slope;
  }
}

TEST(BehindPaint, NoRimBeforeAGradient) {
  Silhouette edge([](int x, int y) { return underLine(x, y, 0.4f, 4.3f); });
  edge.sky = [](int x, int y) {
    return 0.3f + 0.01f * static_cast<float>(x) - 0.005f * static_cast<float>(y);
  };
  edge.lay();
  EXPECT_LT(edge.worst(), 0.01f) << "a pixel or two of the gradient";
}

TEST(BehindPaint, AlphaIsTheCoverageOnATransparentFilm) {
  Silhouette edge([](int x, int y) { return underLine(x, y, 0.4f, 4.3f); });
  edge.sky = [](int, int) { return 0.0f; };
  edge.skyAlpha = 0.0f;
  edge.lay();
  EXPECT_LT(edge.worst(), 1e-6f);
}

// No pixel is wholly sky, and none wholly covered: three struts of half a pixel.
TEST(BehindPaint, UnmixesTheSkyBetweenThingsTooNearToEachOther) {
  Silhouette grid([](int x, int) { return x % 3 == 0 ? 0.9f : x % 3 == 1 ? 0.6f : 0.2f; });
  grid.lay();
  EXPECT_LT(grid.worst(), 1e-4f);
  Silhouette film([](int x, int) { return x % 3 == 0 ? 0.9f : x % 3 == 1 ? 0.6f : 0.2f; });
  film.sky = [](int, int) { return 0.0f; };
  film.skyAlpha = 0.0f;
  film.lay();
  EXPECT_LT(film.worst(), 1e-4f);
}

TEST(BehindPaint, InsideAHalfTransparentThingThePictureStandsForBoth) {
  Silhouette veil([](int, int) { return 0.5f; });
  veil.lay();
  EXPECT_FLOAT_EQ(veil.paintR(7, 7), 0.5f * paintRed + 0.5f * veil.r(7, 7));
  EXPECT_FLOAT_EQ(veil.paintA(7, 7), 1.0f);
}

TEST(BehindPaint, OnATransparentFilmAHalfTransparentThingHasNothingBehind) {
  Silhouette veil([](int, int) { return 0.5f; });
  veil.sky = [](int, int) { return 0.0f; };
  veil.skyAlpha = 0.0f;
  veil.lay();
  EXPECT_LT(veil.worst(), 1e-6f);
}

// The film shows at the edge alone; the pixels beside it show something that is not painted.
TEST(BehindPaint, NeverAddsMoreThanThePicturesAlpha) {
  Silhouette edge([](int x, int) { return x < 7 ? 1.0f : x == 7 ? 0.25f : 0.0f; });
  edge.lay();
  Floats alpha(side, side, 1.0f), r(side, side), g(side, side), b(side, side), a(side, side);
  for (int y = 0; y < side; ++y) {
    alpha(7, y) = 0.625f;
    for (int x = 0; x < side; ++x) {
      a(x, y) = edge.coverage(x, y);
      r(x, y) = a(x, y) * paintRed;
    }
  }
  const CoverageRank ranks[] = {{edge.id, edge.coverage}};
  layOverPicture({r.view(), g.view(), b.view(), a.view()}, {edge.r, edge.g, edge.b, alpha}, ranks);
  EXPECT_FLOAT_EQ(a(7, 7), 0.625f);
  EXPECT_FLOAT_EQ(r(7, 7), 0.25f * paintRed + 0.75f * 0.5f * 0.25f) << "half of 0.75 is sky";
  EXPECT_FLOAT_EQ(a(8, 7), 1.0f);
}

TEST(BehindPaint, GapsOfThePaintShowTheRenderedThing) {
  const CoverageRank* none = nullptr;
  Silhouette whole([](int, int) { return 1.0f; });
  whole.lay();
  Floats r(1, 1, 0.2f), g(1, 1, 0.2f), b(1, 1, 0.2f), a(1, 1, 0.5f);
  const Floats seen(1, 1, 0.8f), alpha;
  layOverPicture({r.view(), g.view(), b.view(), a.view()}, {seen, seen, seen, alpha}, {none, 0});
  EXPECT_FLOAT_EQ(r(0, 0), 0.2f + 0.5f * 0.8f) << "without coverage it is over";
  EXPECT_FLOAT_EQ(a(0, 0), 1.0f);
  const Labels id(1, 1, 7u);
  const Floats all(1, 1, 1.0f);
  const CoverageRank ranks[] = {{id, all}};
  r(0, 0) = 0.2f, a(0, 0) = 0.5f;
  layOverPicture({r.view(), g.view(), b.view(), a.view()}, {seen, seen, seen, alpha}, ranks);
  EXPECT_FLOAT_EQ(r(0, 0), 0.2f + 0.5f * 0.8f);
}

TEST(BehindPaint, AThingThatFoundNoPaintStaysAsRendered) {
  Silhouette wire([](int x, int) { return x == 7 ? 0.3f : 0.0f; });
  wire.lay();
  Floats r(side, side, 0.0f), g(side, side, 0.0f), b(side, side, 0.0f), a(side, side, 0.0f);
  const CoverageRank ranks[] = {{wire.id, wire.coverage}};
  layOverPicture({r.view(), g.view(), b.view(), a.view()}, {wire.r, wire.g, wire.b, wire.a}, ranks);
  EXPECT_EQ(r(7, 7), wire.r(7, 7));
}

TEST(BehindPaint, OverAGroundOnlyWhatIsLeftOpenShowsIt) {
  // Wider than one run of pixels, so that the second one is asked for at its own place.
  constexpr int width = ColourRun::most + 3;
  Floats r(width, 1), g(width, 1, 0.25f), b(width, 1, 0.0f), a(width, 1);
  ColourPlanes ground{Floats(width, 1), Floats(width, 1, 1.0f), Floats(width, 1, 0.5f),
                      Floats(width, 1, 0.5f)};
  for (int x = 0; x < width; ++x) {
    a(x, 0) = x % 2 == 0 ? 1.0f : 0.25f;
    r(x, 0) = 0.125f;
    ground.r(x, 0) = float(x);
  }
  ground.r(2, 0) = std::numeric_limits<float>::infinity();
  layOver({r, g, b, a}, PictureGround(std::move(ground)));
  for (int x = 0; x < width; ++x) {
    const bool covered = x % 2 == 0;
    ASSERT_EQ(r(x, 0), covered ? 0.125f : 0.125f + 0.75f * float(x)) << x;
    ASSERT_EQ(g(x, 0), covered ? 0.25f : 1.0f) << x;
    ASSERT_EQ(a(x, 0), covered ? 1.0f : 0.625f) << x;
  }
}

}  // namespace
}  // namespace kagefude
