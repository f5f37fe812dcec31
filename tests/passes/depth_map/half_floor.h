#pragma once

#include "passes/depth_map/map_floor.h"

namespace kagefude {

/// A row of a floor that may lie in half a shadow, and masks in which whatever has x < edge is
/// dark.
struct HalfFloor : MapFloor {
  static constexpr int count = 200;
  static constexpr float radius = 0.5f;  ///< of the light

  HalfFloor() : MapFloor(count) {}

  void blockLeft() {
    block(5, [](int x, int) { return x < 128; });
  }
  float x(int i) const { return position.view()(i, 0).x; }
  Bytes maskTo(float edge) const {
    Bytes mask(count, 1, uint8_t{0});
    for (int i = 0; i < count; ++i) mask(i, 0) = x(i) > edge;
    return mask;
  }
};

}  // namespace kagefude
