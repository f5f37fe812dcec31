#include "image/sparse_plane.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace kagefude {
namespace {

/// 70 wide: two blocks and a part of one.
SparsePlane planeWith(std::initializer_list<int> columns) {
  std::vector<uint32_t> row(70, 0);
  for (const int x : columns) row[static_cast<size_t>(x)] = static_cast<uint32_t>(x) + 1;
  SparsePlane plane(70, 3);
  plane.setRow(1, row.data());
  return plane;
}

TEST(SparsePlane, HoldsWhatItWasGivenAndZerosElsewhere) {
  const SparsePlane plane = planeWith({0, 31, 69});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 70; ++x) {
      const bool set = y == 1 && (x == 0 || x == 31 || x == 69);
      EXPECT_EQ(plane(x, y), set ? static_cast<uint32_t>(x) + 1 : 0u) << x << " " << y;
    }
}

TEST(SparsePlane, KeepsOnlyBlocksThatHoldSomething) {
  EXPECT_EQ(planeWith({}).bytes(), 0u);
  EXPECT_EQ(planeWith({}).keptOf(1).size(), 0u);
  EXPECT_EQ(planeWith({40}).keptOf(1).size(), 32u);
  EXPECT_EQ(planeWith({40}).keptOf(0).size(), 0u);
  EXPECT_EQ(planeWith({3, 69}).bytes(), (3u + 2 * 32) * 4);
}

TEST(SparsePlane, ARowIsSetAnew) {
  SparsePlane plane = planeWith({5, 50});
  const std::vector<uint32_t> zeros(70, 0);
  plane.setRow(1, zeros.data());
  EXPECT_EQ(plane(5, 1), 0u);
  EXPECT_EQ(plane.bytes(), 0u);
}

TEST(SparsePlane, ClearsAndChangesWhatIsKept) {
  SparsePlane plane = planeWith({5, 6});
  plane.clear(5, 1);
  plane.clear(60, 1);
  plane.clear(5, 0);
  EXPECT_EQ(plane(5, 1), 0u);
  EXPECT_EQ(plane(6, 1), 7u);
  std::ranges::replace(plane.keptOf(1), 7u, 9u);
  EXPECT_EQ(plane(6, 1), 9u);
}

TEST(SparsePlane, KeepsTheBitsOfFloats) {
  std::vector<float> row(70, 0.0f);
  row[1] = 0.25f;
  row[33] = -0.0f;
  SparsePlane plane(70, 1);
  plane.setRow(0, row.data());
  EXPECT_EQ(plane.asFloat(1, 0), 0.25f);
  EXPECT_EQ(plane(33, 0), 0x80000000u);
}

}  // namespace
}  // namespace kagefude
