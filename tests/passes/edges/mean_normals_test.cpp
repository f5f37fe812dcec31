#include "passes/edges/mean_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace kagefude {
namespace {

constexpr int wide = 24, high = 9;
const V3f level(0, 0, 1), risen(0, -0.8f, 0.6f), lip(0, 0.8f, 0.6f);

// One thing of three surfaces: a wall above (white), a lip (half red), an inside below (black),
// whose borders are lines of a small slope. The lip is `thick` pixels high.
struct Bowl {
  double thick;
  Labels ids{wide, high, 1u}, own{wide, high, 1u}, first{wide, high, 1u};
  std::vector<uint32_t> objects{0, 1};  ///< of the styles
  Plane<uint16_t> styles{wide, high, uint16_t{1}};
  Floats share{wide, high, 1.0f};
  Vec3Plane normal{wide, high}, position{wide, high}, mean{wide, high};
  Floats r{wide, high}, g{wide, high, 0.0f}, b{wide, high, 0.0f}, a{wide, high, 1.0f};
  Bytes joins;

  explicit Bowl(double lipThick) : thick(lipThick) {
    for (int y = 0; y < high; ++y)
      for (int x = 0; x < wide; ++x) {
        const int here = surface(x + 0.5, y + 0.5);
        normal.set(x, y, normalOf(here));
        // The lip lies far before the other two.
        position.set(x, y, V3f(x + 0.5f, y + 0.5f, here == 1 ? 40.0f : 0.0f));
        r(x, y) = colourOf(here);
        V3f sum(0.0f);
        for (int i = 0; i < 256; ++i)
          sum += normalOf(surface(x + (i % 16 + 0.5) / 16, y + (i / 16 + 0.5) / 16));
        mean.set(x, y, sum / 256.0f);
      }
    labelSurfaces(ids, normal, position, {}, &joins);
  }

  int surface(double x, double y) const {
    const double below = y - 4.2 - 0.09 * x;
    return below < 0 ? 0 : below < thick ? 1 : 2;
  }
  static V3f normalOf(int here) { return here == 0 ? level : here == 1 ? lip : risen; }
  static float colourOf(int here) { return here == 0 ? 1.0f : here == 1 ? 0.5f : 0.0f; }

  float truth(int x, int y) const {
    float sum = 0;
    for (int i = 0; i < 256; ++i)
      sum += colourOf(surface(x + (i % 16 + 0.5) / 16, y + (i / 16 + 0.5) / 16));
    return sum / 256;
  }
  EdgeSurfaces surfaces() const { return {objects, styles, joins, normal, position}; }

  ColourPlanes blend() const {
    const CoverageRank ranks[] = {{first, share}};
    return blend(ranks);
  }
  ColourPlanes blend(std::span<const CoverageRank> ranks) const {
    ColourPlanes colour{r.clone(), g.clone(), b.clone(), a.clone()};
    blendByMeanNormals({colour.r, colour.g, colour.b, colour.a}, {surfaces(), own, ranks, mean});
    return colour;
  }
  // What is known without the mean.
  ColourPlanes blendWithout() const {
    ColourPlanes colour{r.clone(), g.clone(), b.clone(), a.clone()};
    const PaintViews paint{colour.r, colour.g, colour.b, colour.a};
    blendInnerEdges(surfaces(), paint);
    const CoverageRank ranks[] = {{first, share}};
    blendByCoverage(paint, own, ranks);
    return colour;
  }
  // Greatest over the pixels away from the frame's border.
  float error(const ColourPlanes& result) const {
    float worst = 0;
    for (int y = 1; y < high - 1; ++y)
      for (int x = 2; x < wide - 2; ++x)
        worst = std::max(worst, std::abs(result.r(x, y) - truth(x, y)));
    return worst;
  }
};

TEST(MeanNormals, ALineThinnerThanAPixelIsEven) {
  for (const double thick : {0.3, 0.6, 0.9}) {
    Bowl bowl(thick);
    const ColourPlanes result = bowl.blend();
    EXPECT_LT(bowl.error(result), 0.04f) << thick;
    EXPECT_GT(bowl.error(bowl.blendWithout()), 0.12f) << thick << ": dashes, without the normals";
  }
}

// Ranks name a thing once; a damaged file may name it in all.
TEST(MeanNormals, AThingInSeveralRanksIsOneThing) {
  Bowl bowl(0.6);
  const ColourPlanes once = bowl.blend();
  const Floats quarter(wide, high, 0.25f);
  const CoverageRank ranks[] = {
      {bowl.first, quarter}, {bowl.first, quarter}, {bowl.first, quarter}, {bowl.first, quarter}};
  const ColourPlanes four = bowl.blend(ranks);
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) {
      EXPECT_NEAR(four.r(x, y), once.r(x, y), 1e-5f) << x << " " << y;
      EXPECT_NEAR(four.a(x, y), 1.0f, 1e-5f);
    }
}

TEST(MeanNormals, AwayFromEdgesNothingChanges) {
  Bowl bowl(0.6);
  const ColourPlanes result = bowl.blend();
  for (int x = 0; x < wide; ++x) {
    EXPECT_EQ(result.r(x, 1), bowl.r(x, 1)) << x;
    EXPECT_EQ(result.r(x, 7), x > 10 ? result.r(x, 7) : bowl.r(x, 7)) << x;
  }
}

TEST(MeanNormals, NormalsOfOneDirectionLeaveTheMixtureThatIsKnownWithout) {
  Bowl bowl(0.6);
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) {
      bowl.normal.set(x, y, level);
      bowl.mean.set(x, y, level);
    }
  labelSurfaces(bowl.ids, bowl.normal, bowl.position, {}, &bowl.joins);
  const ColourPlanes result = bowl.blend();
  const ColourPlanes without = bowl.blendWithout();
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) EXPECT_NEAR(result.r(x, y), without.r(x, y), 1e-5f) << x << y;
}

TEST(MeanNormals, AlphaIsTheCoverageWhateverTheNormalsSay) {
  Bowl bowl(0.6);
  for (int x = 0; x < wide; ++x) {
    bowl.share(x, 4) = 0.3f + 0.02f * static_cast<float>(x);
    bowl.mean.set(x, 4, V3f(0.5f, -0.2f, 0.1f));
  }
  const ColourPlanes result = bowl.blend();
  for (int x = 0; x < wide; ++x) EXPECT_NEAR(result.a(x, 4), bowl.share(x, 4), 1e-6f) << x;
}

TEST(MeanNormals, WhereTheRestOfTheMeanIsNotKnownTheMixtureWithoutItStands) {
  Bowl bowl(0.6);
  for (int x = 0; x < 12; ++x)
    bowl.mean.set(x, 5, V3f(std::numeric_limits<float>::quiet_NaN(), 0, 0));
  bowl.own(20, 5) = bowl.ids(20, 5) = bowl.styles(20, 5) = 0;  // a surface that is not painted
  bowl.first(20, 5) = 0;
  const ColourPlanes result = bowl.blend();
  const ColourPlanes without = bowl.blendWithout();
  for (const int x : {3, 4, 5, 6, 7, 8, 9, 10, 19, 21})
    EXPECT_NEAR(result.r(x, 5), without.r(x, 5), 1e-5f) << x;
}

}  // namespace
}  // namespace kagefude
