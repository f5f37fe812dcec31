#include "passes/measure/stroke_moves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kagefude {
namespace {

/// Two objects side by side, of 128 pixels each; strokes of one height everywhere.
struct Shot {
  Labels ids{16, 16, 1u};
  Vec3Plane strokes{16, 16};
  WarpError error;

  Shot() {
    error.perPixel = Floats(16, 16, 0.0f);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        if (x >= 8) ids(x, y) = 2u;
        strokes.set(x, y, V3f(0.2f));
      }
  }
};

TEST(StrokeMoves, AreTheChangeOverTheStrokesOfEachObject) {
  Shot shot;
  for (int y = 0; y < 16; ++y)
    for (int x = 8; x < 16; ++x) shot.error.perPixel(x, y) = 0.1f;
  shot.error.perPixel(11, 3) = 0.5f;
  StrokeMoves moves;
  moves.add(7, shot.ids, shot.strokes, shot.error);
  const auto objects = moves.objects({{2u, "Fox"}});
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].name, "Fox") << "the restless one first";
  const double squares = (127 * 0.01 + 0.25) / 128;
  EXPECT_NEAR(objects[0].change, std::sqrt(squares), 1e-6);
  EXPECT_NEAR(objects[0].ratio, std::sqrt(squares) / 0.2, 1e-6);
  EXPECT_EQ(objects[0].worstFrame, 7);
  EXPECT_EQ(objects[0].worstX, 11);
  EXPECT_EQ(objects[0].worstY, 3);
  EXPECT_EQ(objects[0].pixels, 128);
  EXPECT_EQ(objects[1].name, "");
  EXPECT_EQ(objects[1].ratio, 0);
}

TEST(StrokeMoves, TheWorstFrameIsNamedAndFramesAreSummedUp) {
  Shot shot;
  StrokeMoves moves;
  const float changes[] = {0.1f, 0.3f, 0.1f};
  for (int frame = 0; frame < 3; ++frame) {
    shot.error.perPixel.fill(changes[frame]);
    moves.add(frame + 2, shot.ids, shot.strokes, shot.error);
  }
  const auto objects = moves.objects({});
  EXPECT_EQ(objects[0].worstFrame, 3);
  EXPECT_NEAR(objects[0].worst, 1.5, 1e-6);
  EXPECT_NEAR(objects[0].ratio, std::sqrt((0.01 + 0.09 + 0.01) / 3) / 0.2, 1e-6);
  EXPECT_NEAR(moves.picture()(4, 4), std::sqrt((0.01 + 0.09 + 0.01) / 3) / 0.2, 1e-6);
}

TEST(StrokeMoves, WhatIsNotComparedOrHasNoStrokesDoesNotCount) {
  Shot shot;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      if (x < 8 && y > 5) shot.error.perPixel(x, y) = -1.0f;  // 48 pixels are left
      if (x >= 8) shot.strokes.set(x, y, V3f(0.0f));
    }
  StrokeMoves moves;
  moves.add(2, shot.ids, shot.strokes, shot.error);
  const auto objects = moves.objects({});
  ASSERT_EQ(objects.size(), 1u) << "too few pixels of the first";
  EXPECT_EQ(objects[0].id, 2u);
  EXPECT_EQ(objects[0].ratio, 0);
  EXPECT_TRUE(std::isnan(moves.picture()(3, 9)));
  EXPECT_EQ(moves.picture()(12, 9), 0.0f);
  EXPECT_TRUE(StrokeMoves().objects({}).empty());
  EXPECT_TRUE(StrokeMoves().picture().empty());
}

}  // namespace
}  // namespace kagefude
