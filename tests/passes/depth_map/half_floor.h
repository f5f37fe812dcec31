#pragma once

#include "passes/depth_map/shadow_map.h"

namespace kagefude {

/// A floor under a light at (0, 0, 10), and masks in which whatever has x < edge is dark.
struct HalfFloor {
  static constexpr int count = 200;
  static constexpr float radius = 0.5f;  ///< of the light

  Floats depth{256, 256, 10.0f};
  Vec3Plane position{count, 1}, normal{count, 1};
  Labels labels{count, 1, 1u};
  ShadowMap map;

  HalfFloor() {
    for (int i = 0; i < count; ++i) {
      position.set(i, 0, V3f(8.0f * (static_cast<float>(i) + 0.5f) / count - 4, 0, 0));
      normal.set(i, 0, V3f(0, 0, 1));
    }
    map.depth = depth;
    map.lightFromWorld.m[2][3] = -10;
    map.clipFromLight.m[2][2] = -1;
    map.clipFromLight.m[2][3] = -0.2;
    map.clipFromLight.m[3][2] = -1;
    map.clipFromLight.m[3][3] = 0;
  }
  void blockLeft() {
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 128; ++x) depth(x, y) = 5;
  }
  float x(int i) const { return position.view()(i, 0).x; }
  Bytes maskTo(float edge) const {
    Bytes mask(count, 1, uint8_t{0});
    for (int i = 0; i < count; ++i) mask(i, 0) = x(i) > edge;
    return mask;
  }
};

}  // namespace kagefude
