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

  static constexpr float ownElevation = 0.03f;      ///< sine of what is the receiver's own surface
  static constexpr float agreement = 1.0f / 64.0f;  ///< of merged rectangles, radii
  static constexpr float overlap = 1.0f / 256.0f;   ///< of blocks, that they leave no gap, radii
  static constexpr float smallest = 1.0f / 24.0f;   ///< square that one texel stands for, radii

  static float low(float a, float b) { return b < a ? b : a; }
  static float high(float a, float b) { return b > a ? b : a; }

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

// What is asked of every block and texel stands here, so that it is compiled into the search for
// them.

inline float MapShadow::heightOf(float x, float y, float depth) const {
  return depth * steepness(x, y) + (base_.x + base_.y * x + base_.z * y);
}

/// Squared distance from the receiver to a place on the map at a depth.
inline float MapShadow::distance2(float x, float y, float depth) const {
  const float scale = perspective_ ? depth : 1;
  const float nearer = perspective_ ? depth / r_.depth - 1 : 0;
  const float dx = r_.place.x * nearer + (x - r_.u) / r_.texelsPerSlope * scale;
  const float dy = r_.place.y * nearer - (y - r_.v) / r_.texelsPerSlope * scale;
  const float dz = r_.depth - depth;
  return dx * dx + dy * dy + dz * dz;
}

inline bool MapShadow::isAbove(float height, float distance2) const {
  const float over = height - least_;
  return over > 0 && over * over > ownElevation * ownElevation * distance2;
}

/// Whether a texel stands between the receiver and the light, above the receiver's own surface.
inline bool MapShadow::blocks(int x, int y) const {
  const float depth = depth_(x, y);
  if (!(depth < r_.depth)) return false;
  const float column = static_cast<float>(x) + 0.5f, row = static_cast<float>(y) + 0.5f;
  const float height = heightOf(column, row, depth);
  return height > least_ && isAbove(height, distance2(column, row, depth));
}

/// Radii on the light's disc, before its outline, for a texel at that depth.
inline float MapShadow::radiiPerTexel(float depth) const {
  const float between = high(r_.depth - depth, 1e-6f * r_.depth);
  return (perspective_ ? depth : 1) / (r_.texelsPerUnit * between);
}

/// One texel's rectangle, grown until it meets those of its neighbours that block too.
inline LightRectangle MapShadow::texelRectangle(int x, int y) const {
  const float left = static_cast<float>(x) - r_.u, top = static_cast<float>(y) - r_.v;
  const float own = radiiPerTexel(depth_(x, y));
  const auto scaleAt = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= depth_.width || row >= depth_.height) return own;
    return blocks(column, row) ? radiiPerTexel(depth_(column, row)) : own;
  };
  return {low(left * own, left * scaleAt(x - 1, y)) * r_.perRadius.x,
          high((left + 1) * own, (left + 1) * scaleAt(x + 1, y)) * r_.perRadius.x,
          low(top * own, top * scaleAt(x, y - 1)) * r_.perRadius.y,
          high((top + 1) * own, (top + 1) * scaleAt(x, y + 1)) * r_.perRadius.y};
}

/// What the rectangles of a block's texels cover together.
inline LightRectangle MapShadow::blockRectangle(const Block& block) const {
  const float near = radiiPerTexel(block.nearest), far = radiiPerTexel(block.farthest);
  const float left = static_cast<float>(block.x0) - r_.u;
  const float right = static_cast<float>(block.x1 + 1) - r_.u;
  const float top = static_cast<float>(block.y0) - r_.v;
  const float bottom = static_cast<float>(block.y1 + 1) - r_.v;
  return {low(left * near, left * far) * r_.perRadius.x - overlap,
          high(right * near, right * far) * r_.perRadius.x + overlap,
          low(top * near, top * far) * r_.perRadius.y - overlap,
          high(bottom * near, bottom * far) * r_.perRadius.y + overlap};
}

inline MapShadow::Block MapShadow::blockOf(const Node& node) const {
  const DepthPyramid::Level level = pyramid_.level(node.level);
  const int x0 = node.x << node.level, y0 = node.y << node.level;
  return {x0,
          std::min(x0 + (1 << node.level), depth_.width) - 1,
          y0,
          std::min(y0 + (1 << node.level), depth_.height) - 1,
          level.nearest(node.x, node.y),
          level.farthest(node.x, node.y)};
}

/// Whether the block's rectangle lies beside the light whatever its depth: away from the receiver's
/// own place, rectangles only move out as depth grows.
inline bool MapShadow::isAside(const Block& block, float near) const {
  const float right = extent_ / (near * r_.perRadius.x), down = extent_ / (near * r_.perRadius.y);
  return static_cast<float>(block.x0) - r_.u > right ||
         r_.u - static_cast<float>(block.x1 + 1) > right ||
         static_cast<float>(block.y0) - r_.v > down ||
         r_.v - static_cast<float>(block.y1 + 1) > down;
}

/// Bounds of the heights of a block's texels at one depth: linear, so its middle's and half its
/// sides' changes.
inline MapShadow::Heights MapShadow::heightsOf(const Block& block, float depth) const {
  const float x = 0.5f * static_cast<float>(block.x0 + block.x1 + 1);
  const float y = 0.5f * static_cast<float>(block.y0 + block.y1 + 1);
  const float change =
      0.5f * (std::fabs(depth * slope_.y + base_.y) * static_cast<float>(block.x1 - block.x0) +
              std::fabs(depth * slope_.z + base_.z) * static_cast<float>(block.y1 - block.y0));
  const float middle = heightOf(x, y, depth);
  return {middle - change, middle + change};
}

inline float MapShadow::longest2(const Block& block) const {
  float longest = 0;
  for (const int row : {block.y0, block.y1})
    for (const int column : {block.x0, block.x1})
      longest = high(longest, distance2(static_cast<float>(column) + 0.5f,
                                        static_cast<float>(row) + 0.5f, block.nearest));
  return longest;
}

inline MapShadow::Answer MapShadow::judge(const Block& block) const {
  if (!(block.nearest < r_.depth)) return Answer::open;
  const float near = radiiPerTexel(block.nearest);
  if (isAside(block, near)) return Answer::open;
  const bool deep = !(block.farthest < r_.depth);
  const Heights nearer = heightsOf(block, block.nearest);
  const Heights farther = heightsOf(block, deep ? r_.depth : block.farthest);
  if (high(nearer.highest, farther.highest) <= least_) return Answer::open;
  const float width = static_cast<float>(block.x1 - block.x0 + 1);
  if (deep) return isSmall(width * near) ? Answer::middle : Answer::mixed;
  const float far = radiiPerTexel(block.farthest);
  if (isSmall(width * far)) return Answer::middle;
  const LightRectangle cover = blockRectangle(block);
  const float reach = high(high(-cover.x0, cover.x1), high(-cover.y0, cover.y1));
  const bool agree = reach * (far - near) <= agreement * far;
  return agree && isAbove(low(nearer.lowest, farther.lowest), longest2(block)) ? Answer::blocks
                                                                               : Answer::mixed;
}

inline bool MapShadow::isSmall(float radii) const {
  return radii * high(r_.perRadius.x, r_.perRadius.y) < smallest;
}

/// Whether the block's middle texel blocks; a block that holds what does not takes its depth.
inline bool MapShadow::middleBlocks(Block& block) const {
  const int x = (block.x0 + block.x1 + 1) / 2, y = (block.y0 + block.y1 + 1) / 2;
  if (!(block.farthest < r_.depth)) block.nearest = block.farthest = depth_(x, y);
  return blocks(x, y);
}

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
