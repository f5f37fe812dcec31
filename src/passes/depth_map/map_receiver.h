#pragma once

#include "passes/depth_map/shadow_map.h"

namespace kagefude {

/// Points of one row of pixels as a shadow map sees them, each with its tangent plane's depth
/// around it: a value a lane, so that loops over lanes vectorise.
struct MapReceivers {
  static constexpr int capacity = 128;
  static constexpr float open = -1.0f;  ///< a visibility that is not known yet

  bool perspective = false;  ///< then 1/depth is linear over the map, else depth is
  int count = 0;
  int column[capacity];            ///< of the pixel
  float visibility[capacity];      ///< where nothing needs to be looked up; else `open`
  float u[capacity], v[capacity];  ///< place on the map; texel (i, j) covers [i, i+1) x [j, j+1)
  float depth[capacity];           ///< V, planar depth from the light, world units
  float texelsPerUnit[capacity];   ///< texels per world unit across, at this depth
  float slopeU[capacity], slopeV[capacity];  ///< change of 1/V or V per texel on the tangent plane
  float limit[capacity];                     ///< largest change of depth per texel that is followed

  /// Stores the visibilities in a row of pixels, then keeps the open lanes only.
  void storeKnown(float* row);

  /// Depth of a lane's tangent plane du, dv texels away, moved to V by 1 - follow.
  template <bool inPerspective>
  float planeDepth(int lane, float du, float dv, float follow) const {
    const float d = depth[lane];
    const float slope = slopeU[lane] * du + slopeV[lane] * dv;
    const float here = inPerspective ? 1.0f / d + slope : d + slope;
    const float plane = inPerspective ? (here > 0.0f ? 1.0f / here : 3e38f) : here;
    return d + follow * within(plane - d, limit[lane] * (magnitude(du) + magnitude(dv)));
  }

  /// Lowest and highest planeDepth within `radius` texels, a little wide.
  struct Bounds {
    float low, high;
  };
  template <bool inPerspective>
  Bounds planeDepthBounds(int lane, float radius, float steepness, float follow) const {
    const float d = depth[lane], base = inPerspective ? 1.0f / d : d;
    const float change = steepness * radius * 1.0001f;
    const float under = base - change, over = base + change;
    const float low = inPerspective ? 1.0f / over : under;
    const float high = inPerspective ? (under > 0.0f ? 1.0f / under : 3e38f) : over;
    const float most = limit[lane] * radius * 1.4143f;
    const float slack = 1e-5f * magnitude(d);
    return {d + follow * within(low - d, most) - slack,
            d + follow * within(high - d, most) + slack};
  }

 private:
  static float magnitude(float value) { return value < 0.0f ? -value : value; }
  static float within(float value, float most) {
    const float capped = value < most ? value : most;
    return capped > -most ? capped : -most;
  }
};

/// Finds where a map sees points in the world.
class MapProjector {
 public:
  /// lightFromWorld must be affine.
  explicit MapProjector(const ShadowMap& map);

  /// `count` pixels of row y from column x on, at most MapReceivers::capacity. Known at once: 1 for
  /// background (label 0) and for a point that lies behind the light or is not finite; 0 where the
  /// normal points away from the light. Normals may be empty or zero: then no slope. A point may
  /// lie outside the map.
  ///
  /// Slopes: on a plane both depth (orthographic) and its inverse (perspective) are linear in the
  /// map's coordinates. With g the gradients in space of u, v and that depth, and n the normal, the
  /// slopes are what leaves of g_depth - s_u g_u - s_v g_v only a multiple of n.
  void receive(Vec3View position, Vec3View normal, View<const uint32_t> labels, int x, int y,
               int count, MapReceivers& receivers) const;

 private:
  struct Rows;
  Transform lightFromWorld_, clipFromLight_;
  float width_, height_;
  bool perspective_;
};

}  // namespace kagefude
