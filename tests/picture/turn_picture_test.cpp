#include "picture/turn_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace kagefude {
namespace {

// An upright picture of two rows, 1 2 3 over 4 5 6, as each orientation stores it (Exif 2.3: the
// first stored row and column are this side of the picture).
struct Stored {
  int orientation, width;
  std::vector<float> values;
};
const Stored cases[] = {
    {1, 3, {1, 2, 3, 4, 5, 6}},  // top, left
    {2, 3, {3, 2, 1, 6, 5, 4}},  // top, right
    {3, 3, {6, 5, 4, 3, 2, 1}},  // bottom, right
    {4, 3, {4, 5, 6, 1, 2, 3}},  // bottom, left
    {5, 2, {1, 4, 2, 5, 3, 6}},  // left, top
    {6, 2, {3, 6, 2, 5, 1, 4}},  // right, top
    {7, 2, {6, 3, 5, 2, 4, 1}},  // right, bottom
    {8, 2, {4, 1, 5, 2, 6, 3}},  // left, bottom
};

TEST(TurnPicture, EveryOrientationStandsUpright) {
  for (const Stored& stored : cases) {
    Floats plane(stored.width, 6 / stored.width);
    std::copy(stored.values.begin(), stored.values.end(), plane.row(0));
    const Floats upright = turnedUpright(std::move(plane), stored.orientation);
    ASSERT_EQ(upright.width(), 3) << stored.orientation;
    for (int i = 0; i < 6; ++i)
      EXPECT_EQ(upright.row(0)[i], static_cast<float>(i + 1)) << stored.orientation;
  }
}

TEST(TurnPicture, OtherNumbersLeaveItAsItIs) {
  for (const int none : {0, 9, -1}) {
    Floats plane(2, 1);
    plane(0, 0) = 1;
    plane(1, 0) = 2;
    const Floats same = turnedUpright(std::move(plane), none);
    EXPECT_EQ(same(0, 0), 1.0f);
  }
}

}  // namespace
}  // namespace kagefude
