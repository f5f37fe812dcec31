#pragma once

#include <cstdint>
#include <span>

#include "passes/brush/brush_anchor.h"
#include "passes/strip/strip.h"

namespace kagefude {

/// What the brush pass reads, together.
struct BrushInput {
  Vec3View position, normal;
  View<const float> tone;
  View<const uint16_t> index;
  std::span<const BrushAnchor> anchors;
  std::span<const Strip> strips;
  const BrushParams& params;
  Vec3View rest = {};  ///< see applyBrush; may be empty
};

/// Squared distance that stands for "no neighbour".
inline constexpr float noChange = 3.0e38f;

inline bool isFinite(const V3f& v) {
  const float sum = v.x + v.y + v.z;
  return sum - sum == 0.0f;
}

/// Clamped to [0, 1]; NaN gives 0.
inline float clampedUnit(float value) {
  return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

/// Whether an anchor's strokes lie on places at rest.
inline bool liesAtRest(const BrushInput& in, const BrushAnchor& anchor) {
  return anchor.atRest && !in.rest.empty();
}

/// Whether an anchor's strokes keep their size in the world while its skin stretches.
inline bool keepsSizeInWorld(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.stretch == BrushParams::Stretch::world && liesAtRest(in, anchor);
}

/// Where polar and seed strokes have a pixel: its position, or its place at rest under the object's
/// matrix of this frame.
V3f strokePosition(const BrushInput& in, const BrushAnchor& anchor, int x, int y);

/// Brush colour of one pixel at finite position p, in plain steps: what applyBrush means. Rows of
/// the common case are painted faster, within a few roundings of this, by brush_rows.
Rgba brushColourAt(const BrushInput& in, const BrushAnchor& anchor, int x, int y, const V3f& p);

}  // namespace kagefude
