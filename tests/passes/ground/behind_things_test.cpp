#include "passes/ground/behind_things.h"

#include <gtest/gtest.h>

#include "passes/search/nearest_site.h"

namespace kagefude {
namespace {

TEST(BehindThings, OpenPixelsStayAndOthersTakeTheNearest) {
  Floats r(5, 1), g(5, 1, 0.5f), b(5, 1, 0.25f);
  for (int x = 0; x < 5; ++x) r(x, 0) = float(x + 1);
  Bytes open(5, 1, uint8_t{0});
  open(0, 0) = open(4, 0) = 1;
  const ColourPlanes out = extendBehindThings({r, g, b, {}}, open);
  const float expected[] = {1, 1, 1, 5, 5};  // the smaller x of two equally near
  for (int x = 0; x < 5; ++x) {
    EXPECT_EQ(out.r(x, 0), expected[x]);
    EXPECT_EQ(out.g(x, 0), 0.5f);
    EXPECT_EQ(out.a(x, 0), 1.0f);
  }
}

TEST(BehindThings, WhereNothingIsOpenThereIsNothing) {
  Floats r(3, 2, 1.0f), a(3, 2, 1.0f);
  const Bytes open(3, 2, uint8_t{0});
  const ColourPlanes out = extendBehindThings({r, r, r, a}, open);
  EXPECT_EQ(out.r(1, 1), 0.0f);
  EXPECT_EQ(out.a(1, 1), 0.0f);
}

TEST(BehindThings, AlphaGoesWithItsColour) {
  Floats r(3, 1, 0.5f), a(3, 1, 0.0f);
  a(0, 0) = 0.5f;
  Bytes open(3, 1, uint8_t{0});
  open(0, 0) = 1;
  const ColourPlanes out = extendBehindThings({r, r, r, a}, open);
  EXPECT_EQ(out.a(2, 0), 0.5f);
}

TEST(BehindThings, NearbyIsTheSamePixelAsTheWholeSearchFinds) {
  constexpr int side = 40;
  Bytes kinds(side, side);
  uint32_t state = 7;
  for (uint8_t* kind = kinds.row(0); kind != kinds.row(side); ++kind)
    *kind = (state = state * 1664525u + 1013904223u) >> 27 == 0 ? 1 : 0;
  const Labels whole = nearestOpen(kinds, 1, 0);
  int near = 0, far = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (kinds(x, y) != 0) continue;
      const int dx = int(whole(x, y) % side) - x, dy = int(whole(x, y) / side) - y;
      const bool within = dx * dx + dy * dy <= 9;
      ++(within ? near : far);
      ASSERT_EQ(openNearby(kinds, 1, x, y), within ? whole(x, y) : noSite) << x << " " << y;
    }
  EXPECT_GT(near, 100);
  EXPECT_GT(far, 20);
}

}  // namespace
}  // namespace kagefude
