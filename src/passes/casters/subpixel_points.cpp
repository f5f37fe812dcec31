#include "passes/casters/subpixel_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace kagefude {

PointBox SubpixelPoints::box(uint64_t group) const {
  V3f low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (uint64_t rest = group; rest != 0; rest &= rest - 1) {
    const int k = std::countr_zero(rest);
    const V3f p(x[k], y[k], z[k]);
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  return PointBox::around(low, high);
}

uint64_t SubpixelPoints::beforeGap() const {
  std::array<std::pair<float, int>, 64> order;
  size_t count = 0;
  for (uint64_t rest = present; rest != 0; rest &= rest - 1) {
    const int k = std::countr_zero(rest);
    order[count++] = {V3f(x[k], y[k], z[k]).length2(), k};
  }
  if (count < 2) return present;
  std::sort(order.begin(), order.begin() + count);
  float widest = 0;
  size_t behind = count;
  for (size_t i = 1; i < count; ++i)
    if (order[i].first - order[i - 1].first > widest) {
      widest = order[i].first - order[i - 1].first;
      behind = i;
    }
  if (3 * widest < order[count - 1].first - order[0].first) return present;
  uint64_t before = 0;
  for (size_t i = 0; i < behind; ++i) before |= uint64_t{1} << order[i].second;
  return before;
}

}  // namespace kagefude
