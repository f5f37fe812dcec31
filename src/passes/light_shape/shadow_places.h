#pragma once

#include <cstdint>
#include <span>

#include "image/vec.h"

namespace kagefude {

/// Places spread evenly over the light, each between three of its masks, in arrays for gathering.
struct ShadowPlaces {
  static constexpr int most = 80;  ///< a multiple of the lanes that are summed together
  int count = 0;
  float reach = 0;               ///< longest offset
  float x[3][most], y[3][most];  ///< offsets from the three masks, in units of place
  float weight[3][most];         ///< barycentric, at least 0; 1 together inside their mesh
  int32_t mask[3][most];
};

/// `count` (at most ShadowPlaces::most) places on a disc of `radius`, in units of place, or on a
/// rectangle of such half sides where masks lie at its corners. masks: the masks' places, a disc's
/// or a rectangle's grid.
ShadowPlaces placesBetween(std::span<const V2f> masks, int count, float radius);

}  // namespace kagefude
