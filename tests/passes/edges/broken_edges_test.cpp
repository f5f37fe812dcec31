#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "passes/edges/edge_scene.h"

namespace kagefude {
namespace {

TEST(BrokenEdges, AMovedSlantedBorderHasNoStairs) {
  // Things are told by pixels' centres alone. The border falls by a pixel in four; moved by two it
  // is as straight, and covers of each pixel what lies before it.
  for (const float side : {1.0f, -1.0f}) {
    EdgeScene scene(0);
    const float length = std::sqrt(1.0f + 0.0625f);
    const auto inside = [&](int x, int y) {
      return (float(EdgeScene::border) - 0.5f - float(x) + 0.25f * float(y - 4)) / length;
    };
    for (int y = 0; y < EdgeScene::height; ++y)
      for (int x = 0; x < EdgeScene::width; ++x) {
        const bool first = inside(x, y) > 0.0f;
        scene.things(x, y) = first ? 1 : 0;
        scene.r(x, y) = first ? 0.8f : 0.0f;
        scene.a(x, y) = first ? 1.0f : 0.0f;
        scene.grain(x, y) = 1.5f * side;
      }
    scene.params[0].rough = 2;
    scene.paint();
    // Rows whose windows are cut by the frame bend.
    for (int y = 2; y < EdgeScene::height - 2; ++y)
      for (int x = EdgeScene::border - 8; x < EdgeScene::border + 8; ++x) {
        const float moved = inside(x, y) + 2.0f * side;
        const float share = std::min(std::max(moved / 1.3f + 0.5f, 0.0f), 1.0f);
        EXPECT_NEAR(scene.a(x, y), share, 0.15f) << side << " at " << x << " " << y;
      }
  }
}

TEST(BrokenEdges, ABrokenBorderBendsAsALineWhateverItsGrain) {
  EdgeScene scene(0);
  scene.params[0].rough = 4;
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::width; ++x)
      scene.grain(x, y) = (x * 7 + y * 13) % 5 < 2 ? 1.5f : -1.5f;
  scene.paint();
  const auto painted = [&](int y) {
    float sum = 0;
    for (int x = 0; x < EdgeScene::width; ++x) sum += scene.a(x, y);
    return sum;
  };
  float moved = 0;
  for (int y = 0; y < EdgeScene::height; ++y) {
    moved = std::max(moved, std::fabs(painted(y) - EdgeScene::border));
    if (y > 0) {
      EXPECT_LT(std::fabs(painted(y) - painted(y - 1)), 1.5f) << "row " << y;
    }
  }
  EXPECT_GT(moved, 0.3f);
}

TEST(BrokenEdges, AThinThingKeepsItsMiddle) {
  // Nothing is taken of two pixels. Of eight the fourth from the border is 3.5 from it: half of
  // that on both sides.
  for (const int wide : {2, 8}) {
    EdgeScene scene(0);
    for (int y = 0; y < EdgeScene::height; ++y)
      for (int x = 0; x < EdgeScene::width; ++x) {
        const bool first = x >= EdgeScene::border && x < EdgeScene::border + wide;
        scene.things(x, y) = first ? 1 : 0;
        scene.r(x, y) = first ? 0.8f : 0.0f;
        scene.a(x, y) = first ? 1.0f : 0.0f;
        scene.grain(x, y) = -3.0f;
      }
    scene.params[0].rough = 6;
    scene.paint();
    for (int y = 0; y < EdgeScene::height; ++y) {
      float painted = 0;
      for (int x = 0; x < EdgeScene::width; ++x) painted += scene.a(x, y);
      EXPECT_NEAR(painted, wide == 2 ? 2.0f : 8.0f - 3.5f, 0.15f) << wide << " row " << y;
    }
  }
}

TEST(BrokenEdges, DryPaintIsLeftOutWhereStrokesAlongTheEdgeAreThin) {
  // Thin strokes above, full ones below, among them one hollow pixel.
  EdgeScene scene(0);
  scene.params[0].dry = 1;
  scene.params[0].dryWidth = 4;
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::width; ++x) scene.grain(x, y) = y < 4 ? -3.0f : 3.0f;
  scene.grain(EdgeScene::border - 1, 8) = -3.0f;
  scene.paint();
  EXPECT_EQ(scene.a(EdgeScene::border - 1, 0), 0.0f);
  EXPECT_EQ(scene.r(EdgeScene::border - 1, 0), 0.0f);
  EXPECT_EQ(scene.a(EdgeScene::border - 1, 6), 1.0f);
  EXPECT_EQ(scene.a(EdgeScene::border - 1, 8), 1.0f) << "a hollow in full strokes is no gap";
  EXPECT_EQ(scene.a(EdgeScene::border - 8, 0), 1.0f) << "away from the edge";
}

TEST(BrokenEdges, DryPaintIsAsDryWhetherTheEdgeIsMovedOrNot) {
  EdgeScene still(0), moved(0);
  for (EdgeScene* both : {&still, &moved}) {
    both->params[0].dry = 1;
    both->params[0].dryWidth = 5;
    std::fill_n(both->grain.row(0), EdgeScene::width * EdgeScene::height, -0.6f);
  }
  moved.params[0].rough = 2;
  still.paint();
  moved.paint();
  // The first of these is where the edge's move ends, the others lie beyond.
  for (int x = EdgeScene::border - 3; x > EdgeScene::border - 7; --x)
    EXPECT_NEAR(moved.a(x, 4), still.a(x, 4), 1e-5f) << x;
  EXPECT_LT(still.a(EdgeScene::border - 3, 4), 0.9f) << "some is left out there";
}

TEST(BrokenEdges, ADryGapEndsWithTheThingAndLeavesNoLineRoundIt) {
  // The thing covers a quarter of the column beyond its last pixel.
  EdgeScene scene(0), beside(2);
  for (EdgeScene* both : {&scene, &beside}) {
    both->params[0].dry = 1;
    std::fill_n(both->grain.row(0), EdgeScene::width * EdgeScene::height, -3.0f);
    both->metBeyond = 0.25f;
    both->ids = Labels(EdgeScene::width, EdgeScene::height, 1u);
    both->otherIds = Labels(EdgeScene::width, EdgeScene::height, both == &scene ? 0u : 2u);
    both->share = Floats(EdgeScene::width, EdgeScene::height);
    both->otherShare = Floats(EdgeScene::width, EdgeScene::height);
    for (int y = 0; y < EdgeScene::height; ++y)
      for (int x = 0; x < EdgeScene::width; ++x) {
        both->share(x, y) = x < EdgeScene::border ? 1.0f : x == EdgeScene::border ? 0.25f : 0.0f;
        both->otherShare(x, y) = 1.0f - both->share(x, y);
      }
  }
  scene.paint();
  for (int x = EdgeScene::border - 2; x < EdgeScene::width; ++x)
    EXPECT_EQ(scene.a(x, 4), 0.0f) << x;
  beside.paint();
  // What stands behind keeps its own paint, in its own share.
  EXPECT_NEAR(beside.a(EdgeScene::border - 1, 4), 0.0f, 1e-5f);
  EXPECT_NEAR(beside.a(EdgeScene::border, 4), 0.75f, 1e-5f);
  EXPECT_NEAR(beside.r(EdgeScene::border, 4), 0.75f * 0.2f, 1e-5f);
  EXPECT_EQ(beside.a(EdgeScene::border + 1, 4), 1.0f);
}

TEST(BrokenEdges, EdgesAreLostWhereTonesMeetAndKeptWhereTheyDoNot) {
  EdgeScene close(2, 0.50f, 0.52f), far(2, 0.8f, 0.2f);
  for (EdgeScene* scene : {&close, &far}) {
    for (PaintedEdgeParams& params : scene->params) params.lost = 8;
    scene->paint();
  }
  EXPECT_TRUE(far.isUntouched());
  EXPECT_GT(close.r(EdgeScene::border - 2, 4), 0.5001f);
  EXPECT_LT(close.r(EdgeScene::border + 1, 4), 0.5199f);
  for (int x = 1; x < EdgeScene::width; ++x) EXPECT_GE(close.r(x, 4), close.r(x - 1, 4) - 1e-6f);
}

TEST(BrokenEdges, AtALostEdgeStrokesOfBothSidesReachIntoEachOther) {
  // Roots of 0.5 and 0.52 are 0.0140 apart, of 0.15: lost by 0.9755, so 7.804 of 8 pixels. The step
  // is 1 + 3.902 wide, and strokes reach 1.951 to their side.
  EdgeScene scene(2, 0.50f, 0.52f);
  for (PaintedEdgeParams& params : scene.params) params.lost = 8;
  for (int y = 0; y < EdgeScene::height; ++y)
    for (int x = 0; x < EdgeScene::width; ++x)
      scene.grain(x, y) = y == 2 ? 3.0f : y == 6 ? -3.0f : 0.0f;
  scene.paint();
  const auto expected = [](float inside) {
    const float share = std::min(std::max(inside / 4.902f + 0.5f, 0.0f), 1.0f);
    return 0.5f * share + 0.52f * (1.0f - share);
  };
  for (int x = EdgeScene::border - 4; x < EdgeScene::border + 4; ++x) {
    const float inside = EdgeScene::border - 0.5f - float(x);
    EXPECT_NEAR(scene.r(x, 4), expected(inside), 2e-4f) << x;
    EXPECT_NEAR(scene.r(x, 2), expected(inside + 1.951f), 2e-4f) << x;
    EXPECT_NEAR(scene.r(x, 6), expected(inside - 1.951f), 2e-4f) << x;
  }
}

TEST(BrokenEdges, AgainstTheBackgroundAnEdgeIsLostOnlyWhereTheGroundIsKnown) {
  EdgeScene unknown(0, 0.5f), known(0, 0.5f);
  const Floats ground(EdgeScene::width, EdgeScene::height, 0.5f),
      opaque(EdgeScene::width, EdgeScene::height, 1.0f);
  unknown.params[0].lost = known.params[0].lost = 8;
  unknown.paint();
  const PictureGround picture({ground.clone(), ground.clone(), ground.clone(), opaque.clone()});
  known.paint(&picture);
  EXPECT_TRUE(unknown.isUntouched());
  EXPECT_LT(known.a(EdgeScene::border - 2, 4), 0.9f);
  EXPECT_GT(known.a(EdgeScene::border + 1, 4), 0.1f);
}

}  // namespace
}  // namespace kagefude
