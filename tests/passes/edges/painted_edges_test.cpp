#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/error.h"
#include "passes/edges/edge_scene.h"

namespace kagefude {
namespace {

TEST(PaintedEdges, WithoutAnyEffectEveryBitStays) {
  EdgeScene scene(2);
  scene.paint();
  EXPECT_TRUE(scene.isUntouched());
}

TEST(PaintedEdges, StrokesAboveTheMeanOverrunAndBelowItBreak) {
  for (const float side : {1.0f, -1.0f}) {
    EdgeScene scene(0);
    scene.params[0].rough = 3;
    std::fill_n(scene.grain.row(0), EdgeScene::width * EdgeScene::height, 1.5f * side);
    scene.paint();
    // The border moves by three pixels; beyond it a pixel's step of 1.45.
    const int moved = EdgeScene::border + int(3 * side);
    EXPECT_NEAR(scene.a(moved - 2, 4), 1.0f, 1e-5f) << side;
    EXPECT_NEAR(scene.a(moved + 1, 4), 0.0f, 1e-5f) << side;
    EXPECT_NEAR(scene.a(moved - 1, 4) + scene.a(moved, 4), 1.0f, 1e-5f) << side;
    EXPECT_NEAR(scene.r(moved - 1, 4), 0.8f * scene.a(moved - 1, 4), 1e-5f);
  }
}

TEST(PaintedEdges, OverrunChoosesTheSide) {
  for (const float way : {1.0f, -1.0f}) {
    EdgeScene scene(0);
    scene.params[0].rough = 2;
    scene.params[0].overrun = way;
    scene.paint();
    EXPECT_EQ(scene.a(EdgeScene::border, 4) > 0.9f, way > 0);
    EXPECT_EQ(scene.a(EdgeScene::border - 1, 4) < 0.1f, way < 0);
  }
}

TEST(PaintedEdges, TheThingInFrontDecidesByItsOwnGrain) {
  EdgeScene scene(2);
  scene.params[0].rough = scene.params[1].rough = 3;
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::width; ++x)
      scene.grain(x, y) = x < EdgeScene::border ? 1.5f : -3.0f;
  scene.paint();
  EXPECT_NEAR(scene.r(EdgeScene::border + 1, 4), 0.8f, 1e-5f);
  EXPECT_NEAR(scene.r(EdgeScene::border + 4, 4), 0.2f, 1e-5f);
  for (int x = 0; x < EdgeScene::width; ++x) EXPECT_EQ(scene.a(x, 4), 1.0f);
  // The other way round the right one is in front and breaks.
  EdgeScene turned(2);
  turned.params = scene.params;
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::width; ++x) {
      turned.grain(x, y) = x < EdgeScene::border ? 1.5f : -3.0f;
      turned.distance(x, y) = x < EdgeScene::border ? 2.0f : 1.0f;
    }
  turned.paint();
  EXPECT_NEAR(turned.r(EdgeScene::border + 1, 4), 0.8f, 1e-5f);
}

TEST(PaintedEdges, CoveragePlacesTheBorderWithinThePixel) {
  // The last covered column holds 1, then 0.25: the border lies a quarter of a pixel further.
  EdgeScene scene(0);
  scene.params[0].rough = 1e-4f;
  scene.ids = Labels(EdgeScene::width, EdgeScene::height, 1u);
  scene.share = Floats(EdgeScene::width, EdgeScene::height);
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::width; ++x)
      scene.share(x, y) = x < EdgeScene::border ? 1.0f : x == EdgeScene::border ? 0.25f : 0.0f;
  scene.paint();
  EXPECT_NEAR(scene.a(EdgeScene::border - 1, 4), 1.0f, 1e-3f);
  EXPECT_NEAR(scene.a(EdgeScene::border, 4), 0.25f, 1e-3f);
  EXPECT_NEAR(scene.a(EdgeScene::border + 1, 4), 0.0f, 1e-3f);
}

TEST(PaintedEdges, TheRimOfAWashIsDenserAndEndsWhereItsWidthEnds) {
  EdgeScene scene(0, 0.5f);
  scene.params[0].rim = 8;
  scene.params[0].rimStrength = 1;
  scene.paint();
  // At 1.5 pixels of 8: t = 0.1875, eased(0.75) = 0.84375.
  EXPECT_NEAR(scene.r(EdgeScene::border - 2, 4), std::pow(0.5f, 1.84375f), 1e-4f);
  EXPECT_EQ(scene.r(EdgeScene::border - 9, 4), 0.5f);
  EXPECT_EQ(scene.r(EdgeScene::border, 4), 0.0f);
  for (int x = 0; x < EdgeScene::border; ++x) EXPECT_EQ(scene.a(x, 4), 1.0f);
}

TEST(PaintedEdges, TheRimOfADarkThingIsADeeperToneOfItAndNotBlack) {
  EdgeScene scene(0);
  scene.params[0].rim = 8;
  scene.params[0].rimStrength = 1;
  const V3f plum(0.06f, 0.01f, 0.09f);
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::border; ++x) {
      scene.r(x, y) = plum.x;
      scene.g(x, y) = plum.y;
      scene.b(x, y) = plum.z;
    }
  scene.paint();
  const auto luminance = [](const V3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
  const V3f rim(scene.r(EdgeScene::border - 2, 4), scene.g(EdgeScene::border - 2, 4),
                scene.b(EdgeScene::border - 2, 4));
  // As dense as in the test above: no less than 1 / 1.84375 as bright, where c^d would be 0.03.
  EXPECT_NEAR(luminance(rim) / luminance(plum), 1 / 1.84375f, 1e-3f);
  EXPECT_LT(rim.y / rim.z, plum.y / plum.z) << "its colour is purer";
  EXPECT_NEAR(std::log(rim.x / rim.z), 1.84375f * std::log(plum.x / plum.z), 1e-3f);
}

TEST(PaintedEdges, WhereOneThingStandsOnAnotherTheSmallerIsInFrontAllAlong) {
  // The right thing is smaller; distances meet at the border, now one nearer and now the other, by
  // less than they change from pixel to pixel.
  EdgeScene scene(2, 0.5f, 0.5f);
  scene.params[0].rim = scene.params[1].rim = 6;
  scene.params[0].rimStrength = scene.params[1].rimStrength = 1;
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::width; ++x) {
      if (x >= EdgeScene::border + 8) scene.things(x, y) = 1;
      const float apart = y % 2 ? 0.15f : -0.15f;
      scene.distance(x, y) =
          9 + 0.2f * float(x - EdgeScene::border) + (x < EdgeScene::border ? apart : 0.0f);
    }
  scene.paint();
  for (int y = 0; y < EdgeScene::height; ++y) {
    EXPECT_LT(scene.r(EdgeScene::border + 1, y), 0.4f) << "the rim lies on the smaller, row " << y;
    EXPECT_EQ(scene.r(EdgeScene::border - 2, y), 0.5f) << "and not on the other, row " << y;
  }
}

TEST(PaintedEdges, SettingsOfOneStyleLeaveOtherBordersAlone) {
  EdgeScene scene(2);
  scene.params.resize(3);
  scene.params[2].rough = 4;  // of a thing that is not there
  scene.paint();
  EXPECT_TRUE(scene.isUntouched());
}

TEST(PaintedEdges, AThingOfOnePixelAndAFrameOfOneAreTaken) {
  EdgeScene scene(0);
  std::fill_n(scene.things.row(0), EdgeScene::width * EdgeScene::height, uint16_t{0});
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
    EdgeScene scene(2);
    for (PaintedEdgeParams& params : scene.params) {
      params.rough = 3;
      params.rim = 5;
      params.dry = 0.5f;
      params.lost = 6;
    }
    for (int y = 0; y < EdgeScene::height; ++y)
      for (int x = 0; x < EdgeScene::width; ++x)
        scene.grain(x, y) = float((x * 7 + y * 13) % 11) / 4 - 1.2f;
    scene.paint();
    return scene.r.clone();
  };
  const Floats many = made();
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Floats single = made();
  for (size_t i = 0; i < many.view().pixels(); ++i) ASSERT_EQ(many.row(0)[i], single.row(0)[i]);
}

TEST(PaintedEdges, PlanesOfAnotherSizeAreRefused) {
  EdgeScene scene(2);
  scene.params[0].rough = 1;
  scene.grain = Floats(3, 3);
  EXPECT_THROW(scene.paint(), InputError);
}

}  // namespace
}  // namespace kagefude
