#include "passes/depth_map/light_points.h"

#include <bit>

#include "passes/depth_map/map_taps.h"

namespace kagefude {

int HiddenPoints::count() const {
  int count = 0;
  for (const uint64_t word : words) count += std::popcount(word);
  return count;
}

LightPoints::LightPoints()
    : points_(spiralPoints(size)), belowX_(cells + 1, Words{}), belowY_(cells + 1, Words{}) {
  for (size_t i = 0; i < points_.size(); ++i) {
    const uint64_t bit = uint64_t{1} << (i % 64);
    for (size_t cell = cellOf(points_[i].x) + 1; cell <= cells; ++cell)
      belowX_[cell][i / 64] |= bit;
    for (size_t cell = cellOf(points_[i].y) + 1; cell <= cells; ++cell)
      belowY_[cell][i / 64] |= bit;
  }
}

void LightPoints::hideBelow(float middle, const V2f& slope, HiddenPoints& hidden) const {
  for (size_t i = 0; i < points_.size(); ++i)
    if (!(middle + points_[i].dot(slope) > 0)) hidden.words[i / 64] |= uint64_t{1} << (i % 64);
}

}  // namespace kagefude
