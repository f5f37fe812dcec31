#pragma once

#include <optional>

#include "passes/shadow_map.h"

namespace kagefude {

/// A surface point as a shadow map sees it, with the tangent plane's depth around it.
struct MapReceiver {
  float u = 0, v = 0;        ///< place on the map, texels; texel (i, j) covers [i, i+1) x [j, j+1)
  bool turnedAway = false;   ///< the normal points away from the light
  float depth = 0;           ///< V, planar depth from the light, world units
  float texelsPerUnit = 0;   ///< texels per world unit across, at this depth
  bool perspective = false;  ///< then 1/depth is linear over the map, else depth is
  float base = 0;            ///< 1/V or V
  float slopeU = 0, slopeV = 0;  ///< change of `base` per texel on the tangent plane
  float limit = 0;               ///< largest change of depth per texel that is followed

  /// Depth of the tangent plane du, dv texels away, moved to V by 1 - follow.
  float planeDepth(float du, float dv, float follow) const;
  /// Bounds of planeDepth within `radius` texels, a little wide.
  struct Bounds {
    float low, high;
  };
  Bounds planeDepthBounds(float radius, float follow) const;
};

/// Where the map sees a point with a normal (world space; a zero normal has no slope). Nothing when
/// it lies behind the light or its position is not finite. It may lie outside the map.
std::optional<MapReceiver> receiveOnMap(const ShadowMap& map, const V3f& position,
                                        const V3f& normal);

}  // namespace kagefude
