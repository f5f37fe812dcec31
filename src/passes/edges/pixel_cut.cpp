#include "passes/edges/pixel_cut.h"

#include <algorithm>

namespace kagefude {

void PixelCut::take(const HalfPlane& half) {
  if (count_ + 1 > room) return;
  std::array<Corner, room> left;
  int count = 0;
  for (int i = 0; i < count_; ++i) {
    const auto at = static_cast<size_t>(i), next = static_cast<size_t>((i + 1) % count_);
    const Corner a = corners_[at], b = corners_[next];
    const double ha = half.at(a.x, a.y), hb = half.at(b.x, b.y);
    if (!(ha > 0)) left[static_cast<size_t>(count++)] = a;
    if ((ha > 0) != (hb > 0)) {
      const double t = ha / (ha - hb);
      left[static_cast<size_t>(count++)] = {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
    }
  }
  corners_ = left;
  count_ = count;
}

double PixelCut::area() const {
  double twice = 0;
  for (int i = 0; i < count_; ++i) {
    const Corner a = corners_[static_cast<size_t>(i)];
    const Corner b = corners_[static_cast<size_t>((i + 1) % count_)];
    twice += a.x * b.y - b.x * a.y;
  }
  return std::clamp(twice / 2, 0.0, 1.0);
}

}  // namespace kagefude
