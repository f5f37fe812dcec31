#pragma once

#include <vector>

#include "image/plane.h"

namespace kagefude {

struct DepthRange {
  float nearest, farthest;
};

/// Smallest and largest depth over squares of a shadow map: level k holds those of 2^k texels a
/// side. NaN depths count as infinitely far. Cost: one read of the map; 2/3 of its bytes.
class DepthPyramid {
 public:
  explicit DepthPyramid(View<const float> depth);

  /// Bounds over the whole map.
  DepthRange whole() const;

  struct Level {
    View<const float> nearest, farthest;
    int shift;  ///< texel x lies in column x >> shift
  };
  /// The finest level from 1 on at which `texels` texels in a row touch at most two columns.
  Level levelFor(int texels) const;
  /// Level `shift`, at least 1.
  Level level(int shift) const {
    const auto at = static_cast<size_t>(shift - 1);
    return {nearest_[at], farthest_[at], shift};
  }

 private:
  std::vector<Floats> nearest_, farthest_;  ///< level 1 and up; each halves the one below
};

}  // namespace kagefude
