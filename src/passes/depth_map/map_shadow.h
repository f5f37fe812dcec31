#pragma once

#include <algorithm>
#include <cmath>

#include "passes/depth_map/depth_pyramid.h"
#include "passes/depth_map/shadow_map.h"

namespace kagefude {

// What of a depth map stands before one receiver, as rectangles on the light's disc. On the disc x
// goes right and y down, as on the map, in radii.

/// A point and its normal in the light's space, and where they stand on the map.
struct MapPoint {
  V3f place, normal;
  float u, v, depth;
  float texelsPerUnit;   ///< at the receiver
  float texelsPerSlope;  ///< texels for one of the map's tangents (perspective) or world units
  V2f perRadius;         ///< 1/radius of the light's outline on the plane of its centre
};

struct LightRectangle {
  float x0, x1, y0, y1;

  bool holds(const V2f& place) const {
    return x0 <= place.x && place.x < x1 && y0 <= place.y && place.y < y1;
  }
};

/// The texels and squares of texels between one receiver and the light.
class MapShadow {
 public:
  static constexpr float farthest = 512;  ///< of a texel from the receiver, texels

  /// All must outlive this. bias: texel widths at the receiver. extent: radii of the light's disc
  /// within which rectangles are wanted.
  MapShadow(View<const float> depth, const DepthPyramid& pyramid, bool perspective,
            const MapPoint& receiver, float bias, float extent);

  /// Calls hide(LightRectangle) for what blocks, until that returns false. Squares of texels that
  /// all block and whose rectangles would agree to 1/64 radius come as one; so do squares whose
  /// rectangle is below 1/24 radius, as their middle texel is.
  template <class Hide>
  void eachRectangle(const Hide& hide) const;

 private:
  struct Node {
    int level, x, y;  ///< of the pyramid; level 0: a texel
  };
  struct Block {
    int x0, x1, y0, y1;  ///< texels, inclusive
    float nearest, farthest;
  };
  struct Heights {
    float lowest, highest;
  };
  enum class Answer { open, blocks, middle, mixed };

  float windowOf() const;
  float reachOf(float blocker) const;
  float nearestWithin(float reach) const;
  float steepness(float x, float y) const { return slope_.x + slope_.y * x + slope_.z * y; }
  float heightOf(float x, float y, float depth) const;
  float distance2(float x, float y, float depth) const;
  bool isAbove(float height, float distance2) const;
  bool blocks(int x, int y) const;
  float radiiPerTexel(float depth) const;
  LightRectangle texelRectangle(int x, int y) const;
  LightRectangle blockRectangle(const Block& block) const;
  Block blockOf(const Node& node) const;
  bool isAside(const Block& block, float near) const;
  Heights heightsOf(const Block& block, float depth) const;
  float longest2(const Block& block) const;
  Answer judge(const Block& block) const;
  bool isSmall(float radii) const;
  bool middleBlocks(Block& block) const;

  View<const float> depth_;
  const DepthPyramid& pyramid_;
  bool perspective_;
  const MapPoint& r_;
  float least_, extent_;
  V3f slope_, base_;  ///< of heights over the receiver's tangent plane (heightOf)
};

template <class Hide>
void MapShadow::eachRectangle(const Hide& hide) const {
  const float reach = windowOf();
  const DepthPyramid::Level top = pyramid_.levelFor(static_cast<int>(2 * reach) + 3);
  const auto firstOf = [&](float place, int count) {
    return std::clamp(static_cast<int>(std::floor(place - reach)), 0, count - 1) >> top.shift;
  };
  const auto lastOf = [&](float place, int count) {
    return std::clamp(static_cast<int>(std::floor(place + reach)), 0, count - 1) >> top.shift;
  };
  Node stack[4 + 3 * 32];
  int held = 0;
  for (int y = firstOf(r_.v, depth_.height); y <= lastOf(r_.v, depth_.height); ++y)
    for (int x = firstOf(r_.u, depth_.width); x <= lastOf(r_.u, depth_.width); ++x)
      stack[held++] = {top.shift, x, y};
  while (held > 0) {
    const Node node = stack[--held];
    if (node.level == 0) {
      if (blocks(node.x, node.y) && !hide(texelRectangle(node.x, node.y))) return;
      continue;
    }
    Block block = blockOf(node);
    const Answer answer = judge(block);
    if (answer == Answer::open) continue;
    if (answer != Answer::mixed) {
      if (answer == Answer::middle && !middleBlocks(block)) continue;
      if (!hide(blockRectangle(block))) return;
      continue;
    }
    const int below = node.level - 1;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const Node child{below, 2 * node.x + i, 2 * node.y + j};
        if (child.x << below < depth_.width && child.y << below < depth_.height)
          stack[held++] = child;
      }
  }
}

}  // namespace kagefude
