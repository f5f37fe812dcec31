#include "passes/ground/tooth_tile.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace kagefude {
namespace {

PaperParams paper(PaperParams::Kind kind, float grain) {
  PaperParams params;
  params.kind = kind;
  params.grain = grain;
  return params;
}

constexpr PaperParams::Kind kinds[] = {PaperParams::Kind::rough, PaperParams::Kind::canvas,
                                       PaperParams::Kind::laid};

TEST(ToothTile, AnyShareOfThePaperLiesBelowTheHeightOfThatShare) {
  for (const PaperParams::Kind kind : kinds) {
    const ToothTile tile(paper(kind, 5));
    const double pixels = double(tile.size()) * tile.size();
    for (const float share : {0.1f, 0.25f, 0.5f, 0.75f, 0.9f}) {
      int below = 0;
      for (int y = 0; y < tile.size(); ++y)
        for (int x = 0; x < tile.size(); ++x) below += tile.at(x, y).height < share;
      EXPECT_NEAR(below / pixels, share, 0.005) << int(kind);
    }
  }
}

TEST(ToothTile, RepeatsWithoutASeam) {
  for (const PaperParams::Kind kind : kinds) {
    const ToothTile tile(paper(kind, 6));
    const int last = tile.size() - 1;
    double inside = 0, across = 0;
    for (int i = 0; i <= last; ++i) {
      EXPECT_EQ(tile.at(i, 3).height, tile.at(i - tile.size(), 3 + 2 * tile.size()).height);
      inside += std::fabs(tile.at(i, last - 1).height - tile.at(i, last).height) +
                std::fabs(tile.at(last - 1, i).height - tile.at(last, i).height);
      across += std::fabs(tile.at(i, last).height - tile.at(i, 0).height) +
                std::fabs(tile.at(last, i).height - tile.at(0, i).height);
    }
    // Steps over the seam are those of any two rows, by the row at which the pattern is cut.
    EXPECT_LT(across, 2.5 * inside) << int(kind);
  }
}

TEST(ToothTile, BumpsAreAsWideAsAsked) {
  for (const float grain : {4.0f, 16.0f}) {
    const ToothTile tile(paper(PaperParams::Kind::rough, grain));
    EXPECT_NEAR(tile.texelsPerGrain(), grain, 0.02f * grain);
    // A wave crosses the middle height twice; a bump is half of a wave.
    int crossings = 0;
    for (int y = 0; y < tile.size(); ++y)
      for (int x = 0; x < tile.size(); ++x)
        crossings += (tile.at(x, y).height < 0.5f) != (tile.at(x + 1, y).height < 0.5f);
    const double width = double(tile.size()) * tile.size() / crossings;
    EXPECT_NEAR(width, grain, 0.45 * grain);
  }
}

TEST(ToothTile, BetweenTexelsIsBilinear) {
  const ToothTile tile(paper(PaperParams::Kind::canvas, 5));
  const float perTexel = 1 / tile.texelsPerGrain();
  const ToothSample a = tile.at(7, 9), b = tile.at(8, 9);
  EXPECT_NEAR(tile.between(7.5f * perTexel, 9.5f * perTexel).height, a.height, 1e-4f);
  EXPECT_NEAR(tile.between(8.0f * perTexel, 9.5f * perTexel).height, (a.height + b.height) / 2,
              1e-4f);
  const ToothSample c = tile.at(-1, -1), d = tile.between(-0.5f * perTexel, -0.5f * perTexel);
  EXPECT_NEAR(c.height, d.height, 1e-4f);
}

TEST(ToothTile, TheLargestAndTheSmallestGrainAreTakenAndThreadsChangeNothing) {
  for (const float grain : {1.5f, 256.0f}) {
    const ToothTile many(paper(PaperParams::Kind::rough, grain));
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const ToothTile single(paper(PaperParams::Kind::rough, grain));
    for (int i = 0; i < many.size(); ++i)
      ASSERT_EQ(many.at(i, 3 * i).height, single.at(i, 3 * i).height);
  }
}

}  // namespace
}  // namespace kagefude
