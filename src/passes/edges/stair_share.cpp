#include "passes/edges/stair_share.h"

#include <algorithm>

namespace kagefude {
namespace {

// Area under the line that falls from 1/2 at 0 to 0 at `reach`, between `start` and start + 1.
double areaUnder(double start, double reach) {
  const double end = std::min(start + 1, reach);
  if (end <= start) return 0;
  const auto height = [&](double at) { return 0.5 * (1 - at / reach); };
  return (end - start) * (height(start) + height(end)) / 2;
}

}  // namespace

double stairShare(const RunEnd& before, const RunEnd& after) {
  const double reach = (before.pixels + after.pixels + 1) / 2.0;
  double share = 0;
  if (before.turn > 0) share += areaUnder(before.pixels, reach);
  if (after.turn > 0) share += areaUnder(after.pixels, reach);
  return share;
}

}  // namespace kagefude
