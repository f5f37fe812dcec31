#pragma once

#include <functional>

#include "passes/depth_map/shadow_map.h"

namespace kagefude {

/// A floor at z = 0 under a light at (0, 0, 10), whose map of 256 x 256 sees x and y in [-10, 10]
/// there; receivers on a row of the floor, or on more rows of it.
struct MapFloor {
  static constexpr float lightHeight = 10;

  Floats depth{256, 256, lightHeight};
  Vec3Plane position, normal;
  Labels labels;
  ShadowMap map;

  explicit MapFloor(int width = 400, int height = 1, float side = 8)
      : position(width, height), normal(width, height), labels(width, height, 1u) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float across = (static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 0.5f;
        const float down = (static_cast<float>(y) + 0.5f) / static_cast<float>(height) - 0.5f;
        position.set(x, y, V3f(side * across, -side * down, 0));
        normal.set(x, y, V3f(0, 0, 1));
      }
    map.depth = depth;
    map.lightFromWorld.m[2][3] = -lightHeight;
    map.clipFromLight.m[2][2] = -1;
    map.clipFromLight.m[2][3] = -0.2;
    map.clipFromLight.m[3][2] = -1;
    map.clipFromLight.m[3][3] = 0;
  }

  /// Puts a blocker of one depth wherever `there` says of a texel.
  void block(float at, const std::function<bool(int, int)>& there) {
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 256; ++x)
        if (there(x, y)) depth(x, y) = at;
  }
};

}  // namespace kagefude
