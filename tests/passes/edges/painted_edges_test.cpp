#include "passes/edges/painted_edges.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/error.h"

namespace kagefude {
namespace {

constexpr int width = 24, height = 9, border = 12;

/// Two things side by side, or one and the background: the left one (1) ends before column 12.
struct Scene {
  Floats r{width, height}, g{width, height}, b{width, height}, a{width, height, 1.0f};
  Floats ownR, ownG, ownB, ownA;
  Plane<uint16_t> things{width, height};
  Floats distance{width, height}, grain{width, height, 0.0f};
  Labels ids, otherIds;
  Floats share, otherShare;
  float metBeyond = 0;  ///< of the left thing's paint, in the first column beyond it
  std::vector<PaintedEdgeParams> params = std::vector<PaintedEdgeParams>(2);

  explicit Scene(uint16_t right, float left = 0.8f, float other = 0.2f) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool first = x < border;
        things(x, y) = first ? uint16_t{1} : right;
        const float value = first ? left : right ? other : 0.0f;
        r(x, y) = g(x, y) = b(x, y) = value;
        a(x, y) = first || right ? 1.0f : 0.0f;
        distance(x, y) = first ? 1.0f : 2.0f;
      }
  }
  void paint(const ColourViews& ground = {}) {
    ownR = r.clone();
    ownG = g.clone();
    ownB = b.clone();
    ownA = a.clone();
    std::vector<CoverageRank> ranks;
    if (!ids.empty()) ranks.push_back({ids, share});
    if (!otherIds.empty()) ranks.push_back({otherIds, otherShare});
    for (Floats* plane : {&r, &g, &b, &a})
      for (int y = 0; y < height; ++y)
        (*plane)(border, y) += ((*plane)(border - 1, y) - (*plane)(border, y)) * metBeyond;
    const std::vector<uint32_t> own{1, 2};
    EdgePaint in{{ownR, ownG, ownB, ownA}, things, params};
    in.distance = distance;
    in.grain = grain;
    in.coverageIds = own;
    in.coverage = ranks;
    in.ground = ground;
    paintEdges(in, {r, g, b, a});
  }
  bool isUntouched() const {
    for (size_t i = 0; i < r.view().pixels(); ++i)
      if (r.row(0)[i] != ownR.row(0)[i] || a.row(0)[i] != ownA.row(0)[i]) return false;
    return true;
  }
};

TEST(PaintedEdges, WithoutAnyEffectEveryBitStays) {
  Scene scene(2);
  scene.paint();
  EXPECT_TRUE(scene.isUntouched());
}

TEST(PaintedEdges, StrokesAboveTheMeanOverrunAndBelowItBreak) {
  for (const float side : {1.0f, -1.0f}) {
    Scene scene(0);
    scene.params[0].rough = 3;
    std::fill_n(scene.grain.row(0), width * height, 1.5f * side);
    scene.paint();
    // The border moves by three pixels; beyond it a pixel's step of 1.45.
    const int moved = border + int(3 * side);
    EXPECT_NEAR(scene.a(moved - 2, 4), 1.0f, 1e-5f) << side;
    EXPECT_NEAR(scene.a(moved + 1, 4), 0.0f, 1e-5f) << side;
    EXPECT_NEAR(scene.a(moved - 1, 4) + scene.a(moved, 4), 1.0f, 1e-5f) << side;
    EXPECT_NEAR(scene.r(moved - 1, 4), 0.8f * scene.a(moved - 1, 4), 1e-5f);
  }
}

TEST(PaintedEdges, OverrunChoosesTheSide) {
  for (const float way : {1.0f, -1.0f}) {
    Scene scene(0);
    scene.params[0].rough = 2;
    scene.params[0].overrun = way;
    scene.paint();
    EXPECT_EQ(scene.a(border, 4) > 0.9f, way > 0);
    EXPECT_EQ(scene.a(border - 1, 4) < 0.1f, way < 0);
  }
}

TEST(PaintedEdges, TheThingInFrontDecidesByItsOwnGrain) {
  Scene scene(2);
  scene.params[0].rough = scene.params[1].rough = 3;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) scene.grain(x, y) = x < border ? 1.5f : -3.0f;
  scene.paint();
  EXPECT_NEAR(scene.r(border + 1, 4), 0.8f, 1e-5f);
  EXPECT_NEAR(scene.r(border + 4, 4), 0.2f, 1e-5f);
  for (int x = 0; x < width; ++x) EXPECT_EQ(scene.a(x, 4), 1.0f);
  // The other way round the right one is in front and breaks.
  Scene turned(2);
  turned.params = scene.params;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      turned.grain(x, y) = x < border ? 1.5f : -3.0f;
      turned.distance(x, y) = x < border ? 2.0f : 1.0f;
    }
  turned.paint();
  EXPECT_NEAR(turned.r(border + 1, 4), 0.8f, 1e-5f);
}

TEST(PaintedEdges, CoveragePlacesTheBorderWithinThePixel) {
  // The last covered column holds 1, then 0.25: the border lies a quarter of a pixel further.
  Scene scene(0);
  scene.params[0].rough = 1e-4f;
  scene.ids = Labels(width, height, 1u);
  scene.share = Floats(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      scene.share(x, y) = x < border ? 1.0f : x == border ? 0.25f : 0.0f;
  scene.paint();
  EXPECT_NEAR(scene.a(border - 1, 4), 1.0f, 1e-3f);
  EXPECT_NEAR(scene.a(border, 4), 0.25f, 1e-3f);
  EXPECT_NEAR(scene.a(border + 1, 4), 0.0f, 1e-3f);
}

TEST(PaintedEdges, TheRimOfAWashIsDenserAndEndsWhereItsWidthEnds) {
  Scene scene(0, 0.5f);
  scene.params[0].rim = 8;
  scene.params[0].rimStrength = 1;
  scene.paint();
  // At 1.5 pixels of 8: t = 0.1875, eased(0.75) = 0.84375.
  EXPECT_NEAR(scene.r(border - 2, 4), std::pow(0.5f, 1.84375f), 1e-4f);
  EXPECT_EQ(scene.r(border - 9, 4), 0.5f);
  EXPECT_EQ(scene.r(border, 4), 0.0f);
  for (int x = 0; x < border; ++x) EXPECT_EQ(scene.a(x, 4), 1.0f);
}

TEST(PaintedEdges, TheRimOfADarkThingIsADeeperToneOfItAndNotBlack) {
  Scene scene(0);
  scene.params[0].rim = 8;
  scene.params[0].rimStrength = 1;
  const V3f plum(0.06f, 0.01f, 0.09f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < border; ++x) {
      scene.r(x, y) = plum.x;
      scene.g(x, y) = plum.y;
      scene.b(x, y) = plum.z;
    }
  scene.paint();
  const auto luminance = [](const V3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
  const V3f rim(scene.r(border - 2, 4), scene.g(border - 2, 4), scene.b(border - 2, 4));
  // As dense as in the test above: no less than 1 / 1.84375 as bright, where c^d would be 0.03.
  EXPECT_NEAR(luminance(rim) / luminance(plum), 1 / 1.84375f, 1e-3f);
  EXPECT_LT(rim.y / rim.z, plum.y / plum.z) << "its colour is purer";
  EXPECT_NEAR(std::log(rim.x / rim.z), 1.84375f * std::log(plum.x / plum.z), 1e-3f);
}

TEST(PaintedEdges, WhereOneThingStandsOnAnotherTheSmallerIsInFrontAllAlong) {
  // The right thing is smaller; distances meet at the border, now one nearer and now the other, by
  // less than they change from pixel to pixel.
  Scene scene(2, 0.5f, 0.5f);
  scene.params[0].rim = scene.params[1].rim = 6;
  scene.params[0].rimStrength = scene.params[1].rimStrength = 1;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (x >= border + 8) scene.things(x, y) = 1;
      const float apart = y % 2 ? 0.15f : -0.15f;
      scene.distance(x, y) = 9 + 0.2f * float(x - border) + (x < border ? apart : 0.0f);
    }
  scene.paint();
  for (int y = 0; y < height; ++y) {
    EXPECT_LT(scene.r(border + 1, y), 0.4f) << "the rim lies on the smaller, row " << y;
    EXPECT_EQ(scene.r(border - 2, y), 0.5f) << "and not on the other, row " << y;
  }
}

TEST(PaintedEdges, AMovedSlantedBorderHasNoStairs) {
  // Things are told by pixels' centres alone. The border falls by a pixel in four; moved by two it
  // is as straight, and covers of each pixel what lies before it.
  for (const float side : {1.0f, -1.0f}) {
    Scene scene(0);
    const float length = std::sqrt(1.0f + 0.0625f);
    const auto inside = [&](int x, int y) {
      return (float(border) - 0.5f - float(x) + 0.25f * float(y - 4)) / length;
    };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool first = inside(x, y) > 0.0f;
        scene.things(x, y) = first ? 1 : 0;
        scene.r(x, y) = first ? 0.8f : 0.0f;
        scene.a(x, y) = first ? 1.0f : 0.0f;
        scene.grain(x, y) = 1.5f * side;
      }
    scene.params[0].rough = 2;
    scene.paint();
    // Rows whose windows are cut by the frame bend.
    for (int y = 2; y < height - 2; ++y)
      for (int x = border - 8; x < border + 8; ++x) {
        const float moved = inside(x, y) + 2.0f * side;
        const float share = std::min(std::max(moved / 1.3f + 0.5f, 0.0f), 1.0f);
        EXPECT_NEAR(scene.a(x, y), share, 0.15f) << side << " at " << x << " " << y;
      }
  }
}

TEST(PaintedEdges, ABrokenBorderBendsAsALineWhateverItsGrain) {
  Scene scene(0);
  scene.params[0].rough = 4;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) scene.grain(x, y) = (x * 7 + y * 13) % 5 < 2 ? 1.5f : -1.5f;
  scene.paint();
  const auto painted = [&](int y) {
    float sum = 0;
    for (int x = 0; x < width; ++x) sum += scene.a(x, y);
    return sum;
  };
  float moved = 0;
  for (int y = 0; y < height; ++y) {
    moved = std::max(moved, std::fabs(painted(y) - border));
    if (y > 0) {
      EXPECT_LT(std::fabs(painted(y) - painted(y - 1)), 1.5f) << "row " << y;
    }
  }
  EXPECT_GT(moved, 0.3f);
}

TEST(PaintedEdges, AThinThingKeepsItsMiddle) {
  // Nothing is taken of two pixels. Of eight the fourth from the border is 3.5 from it: half of
  // that on both sides.
  for (const int wide : {2, 8}) {
    Scene scene(0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool first = x >= border && x < border + wide;
        scene.things(x, y) = first ? 1 : 0;
        scene.r(x, y) = first ? 0.8f : 0.0f;
        scene.a(x, y) = first ? 1.0f : 0.0f;
        scene.grain(x, y) = -3.0f;
      }
    scene.params[0].rough = 6;
    scene.paint();
    for (int y = 0; y < height; ++y) {
      float painted = 0;
      for (int x = 0; x < width; ++x) painted += scene.a(x, y);
      EXPECT_NEAR(painted, wide == 2 ? 2.0f : 8.0f - 3.5f, 0.15f) << wide << " row " << y;
    }
  }
}

TEST(PaintedEdges, DryPaintIsLeftOutWhereStrokesAlongTheEdgeAreThin) {
  // Thin strokes above, full ones below, among them one hollow pixel.
  Scene scene(0);
  scene.params[0].dry = 1;
  scene.params[0].dryWidth = 4;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) scene.grain(x, y) = y < 4 ? -3.0f : 3.0f;
  scene.grain(border - 1, 8) = -3.0f;
  scene.paint();
  EXPECT_EQ(scene.a(border - 1, 0), 0.0f);
  EXPECT_EQ(scene.r(border - 1, 0), 0.0f);
  EXPECT_EQ(scene.a(border - 1, 6), 1.0f);
  EXPECT_EQ(scene.a(border - 1, 8), 1.0f) << "a hollow in full strokes is no gap";
  EXPECT_EQ(scene.a(border - 8, 0), 1.0f) << "away from the edge";
}

TEST(PaintedEdges, ADryGapEndsWithTheThingAndLeavesNoLineRoundIt) {
  // The thing covers a quarter of the column beyond its last pixel.
  Scene scene(0), beside(2);
  for (Scene* both : {&scene, &beside}) {
    both->params[0].dry = 1;
    std::fill_n(both->grain.row(0), width * height, -3.0f);
    both->metBeyond = 0.25f;
    both->ids = Labels(width, height, 1u);
    both->otherIds = Labels(width, height, both == &scene ? 0u : 2u);
    both->share = Floats(width, height);
    both->otherShare = Floats(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        both->share(x, y) = x < border ? 1.0f : x == border ? 0.25f : 0.0f;
        both->otherShare(x, y) = 1.0f - both->share(x, y);
      }
  }
  scene.paint();
  for (int x = border - 2; x < width; ++x) EXPECT_EQ(scene.a(x, 4), 0.0f) << x;
  beside.paint();
  // What stands behind keeps its own paint, in its own share.
  EXPECT_NEAR(beside.a(border - 1, 4), 0.0f, 1e-5f);
  EXPECT_NEAR(beside.a(border, 4), 0.75f, 1e-5f);
  EXPECT_NEAR(beside.r(border, 4), 0.75f * 0.2f, 1e-5f);
  EXPECT_EQ(beside.a(border + 1, 4), 1.0f);
}

TEST(PaintedEdges, EdgesAreLostWhereTonesMeetAndKeptWhereTheyDoNot) {
  Scene close(2, 0.50f, 0.52f), far(2, 0.8f, 0.2f);
  for (Scene* scene : {&close, &far}) {
    for (PaintedEdgeParams& params : scene->params) params.lost = 8;
    scene->paint();
  }
  EXPECT_TRUE(far.isUntouched());
  EXPECT_GT(close.r(border - 3, 4), 0.5001f);
  EXPECT_LT(close.r(border + 2, 4), 0.5199f);
  for (int x = 1; x < width; ++x) EXPECT_GE(close.r(x, 4), close.r(x - 1, 4) - 1e-6f);
}

TEST(PaintedEdges, AgainstTheBackgroundAnEdgeIsLostOnlyWhereTheGroundIsKnown) {
  Scene unknown(0, 0.5f), known(0, 0.5f);
  const Floats ground(width, height, 0.5f), opaque(width, height, 1.0f);
  unknown.params[0].lost = known.params[0].lost = 8;
  unknown.paint();
  known.paint({ground, ground, ground, opaque});
  EXPECT_TRUE(unknown.isUntouched());
  EXPECT_LT(known.a(border - 2, 4), 0.9f);
  EXPECT_GT(known.a(border + 1, 4), 0.1f);
}

TEST(PaintedEdges, SettingsOfOneStyleLeaveOtherBordersAlone) {
  Scene scene(2);
  scene.params.resize(3);
  scene.params[2].rough = 4;  // of a thing that is not there
  scene.paint();
  EXPECT_TRUE(scene.isUntouched());
}

TEST(PaintedEdges, AThingOfOnePixelAndAFrameOfOneAreTaken) {
  Scene scene(0);
  std::fill_n(scene.things.row(0), width * height, uint16_t{0});
  scene.things(5, 5) = 1;
  scene.params[0].rough = 2;
  scene.paint();
  EXPECT_TRUE(std::isfinite(scene.a(5, 5)));
  Floats one(1, 1, 1.0f);
  const Plane<uint16_t> thing(1, 1, uint16_t{1});
  const std::vector<PaintedEdgeParams> params(1, scene.params[0]);
  const Floats own = one.clone();
  EdgePaint in{{own, own, own, own}, thing, params};
  in.grain = own;
  paintEdges(in, {one, one, one, one});
  EXPECT_EQ(one(0, 0), 1.0f);
}

TEST(PaintedEdges, ThreadsChangeNothing) {
  const auto made = [] {
    Scene scene(2);
    for (PaintedEdgeParams& params : scene.params) {
      params.rough = 3;
      params.rim = 5;
      params.dry = 0.5f;
      params.lost = 6;
    }
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) scene.grain(x, y) = float((x * 7 + y * 13) % 11) / 4 - 1.2f;
    scene.paint();
    return scene.r.clone();
  };
  const Floats many = made();
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Floats single = made();
  for (size_t i = 0; i < many.view().pixels(); ++i) ASSERT_EQ(many.row(0)[i], single.row(0)[i]);
}

TEST(PaintedEdges, PlanesOfAnotherSizeAreRefused) {
  Scene scene(2);
  scene.params[0].rough = 1;
  scene.grain = Floats(3, 3);
  EXPECT_THROW(scene.paint(), InputError);
}

}  // namespace
}  // namespace kagefude
