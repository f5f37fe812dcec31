#include "passes/depth_map/map_shadow.h"

namespace kagefude {
namespace {

constexpr float ownElevation = 0.03f;      ///< sine of what is the receiver's own surface
constexpr float agreement = 1.0f / 64.0f;  ///< of merged rectangles, radii
constexpr float overlap = 1.0f / 256.0f;   ///< of blocks, so that neighbours leave no gap, radii
constexpr float smallest = 1.0f / 24.0f;   ///< square that one texel stands for, radii

float low(float a, float b) { return b < a ? b : a; }
float high(float a, float b) { return b > a ? b : a; }

}  // namespace

// A texel at (x, y) and depth S stands S·(slope · (1, x, y)) + base · (1, x, y) over the tangent
// plane: with P the receiver, V its depth, n its normal, on a perspective map
// n · (S·(Px/V + du, Py/V - dv, -1) - P), on an orthographic one n · (du, -dv, V - S).
MapShadow::MapShadow(View<const float> depth, const DepthPyramid& pyramid, bool perspective,
                     const MapPoint& receiver, float bias, float extent)
    : depth_(depth),
      pyramid_(pyramid),
      perspective_(perspective),
      r_(receiver),
      least_(bias / receiver.texelsPerUnit + 2e-6f * receiver.depth),
      extent_(extent) {
  const V3f& n = r_.normal;
  const float du = n.x / r_.texelsPerSlope, dv = -n.y / r_.texelsPerSlope;
  const float aside = -du * r_.u - dv * r_.v;
  if (perspective_) {
    slope_ = V3f((n.x * r_.place.x + n.y * r_.place.y) / r_.depth - n.z + aside, du, dv);
    base_ = V3f(-n.dot(r_.place), 0, 0);
  } else {
    slope_ = V3f(-n.z, 0, 0);
    base_ = V3f(n.z * r_.depth + aside, du, dv);
  }
}

/// Texels round the receiver that the light's disc covers through a blocker of that depth; the
/// farthest where a mask's place, beside the receiver, leaves that unknown.
float MapShadow::reachOf(float blocker) const {
  const float between = high(0, r_.depth - blocker);
  const float size =
      extent_ * between * r_.texelsPerUnit /
      (low(r_.perRadius.x, r_.perRadius.y) * (perspective_ ? high(blocker, 1e-6f) : 1));
  return 1 + (size < farthest ? size : farthest);
}

float MapShadow::nearestWithin(float reach) const {
  const DepthPyramid::Level level = pyramid_.levelFor(static_cast<int>(2 * reach) + 3);
  const auto column = [&](float u) {
    return std::clamp(static_cast<int>(std::floor(u)), 0, depth_.width - 1) >> level.shift;
  };
  const auto row = [&](float v) {
    return std::clamp(static_cast<int>(std::floor(v)), 0, depth_.height - 1) >> level.shift;
  };
  const int x0 = column(r_.u - reach), x1 = column(r_.u + reach);
  const int y0 = row(r_.v - reach), y1 = row(r_.v + reach);
  const View<const float>& near = level.nearest;
  return low(low(near(x0, y0), near(x1, y0)), low(near(x0, y1), near(x1, y1)));
}

/// Half the side of the window that holds all that can hide the light, texels.
float MapShadow::windowOf() const {
  float reach = reachOf(pyramid_.whole().nearest);
  for (int narrowing = 0; narrowing < 3; ++narrowing)
    reach = low(reach, reachOf(nearestWithin(reach)));
  return reach;
}

float MapShadow::heightOf(float x, float y, float depth) const {
  return depth * steepness(x, y) + (base_.x + base_.y * x + base_.z * y);
}

/// Squared distance from the receiver to a place on the map at a depth.
float MapShadow::distance2(float x, float y, float depth) const {
  const float scale = perspective_ ? depth : 1;
  const float nearer = perspective_ ? depth / r_.depth - 1 : 0;
  const float dx = r_.place.x * nearer + (x - r_.u) / r_.texelsPerSlope * scale;
  const float dy = r_.place.y * nearer - (y - r_.v) / r_.texelsPerSlope * scale;
  const float dz = r_.depth - depth;
  return dx * dx + dy * dy + dz * dz;
}

bool MapShadow::isAbove(float height, float distance2) const {
  const float over = height - least_;
  return over > 0 && over * over > ownElevation * ownElevation * distance2;
}

/// Whether a texel stands between the receiver and the light, above the receiver's own surface.
bool MapShadow::blocks(int x, int y) const {
  const float depth = depth_(x, y);
  if (!(depth < r_.depth)) return false;
  const float column = static_cast<float>(x) + 0.5f, row = static_cast<float>(y) + 0.5f;
  const float height = heightOf(column, row, depth);
  return height > least_ && isAbove(height, distance2(column, row, depth));
}

/// Radii on the light's disc, before its outline, for a texel at that depth.
float MapShadow::radiiPerTexel(float depth) const {
  const float between = high(r_.depth - depth, 1e-6f * r_.depth);
  return (perspective_ ? depth : 1) / (r_.texelsPerUnit * between);
}

/// One texel's rectangle, grown until it meets those of its neighbours that block too.
LightRectangle MapShadow::texelRectangle(int x, int y) const {
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
LightRectangle MapShadow::blockRectangle(const Block& block) const {
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

MapShadow::Block MapShadow::blockOf(const Node& node) const {
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
bool MapShadow::isAside(const Block& block, float near) const {
  const float right = extent_ / (near * r_.perRadius.x), down = extent_ / (near * r_.perRadius.y);
  return static_cast<float>(block.x0) - r_.u > right ||
         r_.u - static_cast<float>(block.x1 + 1) > right ||
         static_cast<float>(block.y0) - r_.v > down ||
         r_.v - static_cast<float>(block.y1 + 1) > down;
}

/// Bounds of the heights of a block's texels at one depth: linear, so its middle's and half its
/// sides' changes.
MapShadow::Heights MapShadow::heightsOf(const Block& block, float depth) const {
  const float x = 0.5f * static_cast<float>(block.x0 + block.x1 + 1);
  const float y = 0.5f * static_cast<float>(block.y0 + block.y1 + 1);
  const float change =
      0.5f * (std::fabs(depth * slope_.y + base_.y) * static_cast<float>(block.x1 - block.x0) +
              std::fabs(depth * slope_.z + base_.z) * static_cast<float>(block.y1 - block.y0));
  const float middle = heightOf(x, y, depth);
  return {middle - change, middle + change};
}

float MapShadow::longest2(const Block& block) const {
  float longest = 0;
  for (const int row : {block.y0, block.y1})
    for (const int column : {block.x0, block.x1})
      longest = high(longest, distance2(static_cast<float>(column) + 0.5f,
                                        static_cast<float>(row) + 0.5f, block.nearest));
  return longest;
}

MapShadow::Answer MapShadow::judge(const Block& block) const {
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

bool MapShadow::isSmall(float radii) const {
  return radii * high(r_.perRadius.x, r_.perRadius.y) < smallest;
}

/// Whether the block's middle texel blocks; a block that holds what does not takes its depth.
bool MapShadow::middleBlocks(Block& block) const {
  const int x = (block.x0 + block.x1 + 1) / 2, y = (block.y0 + block.y1 + 1) / 2;
  if (!(block.farthest < r_.depth)) block.nearest = block.farthest = depth_(x, y);
  return blocks(x, y);
}

}  // namespace kagefude
