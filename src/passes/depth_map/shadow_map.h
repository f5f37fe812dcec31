#pragma once

#include "image/plane.h"
#include "image/vec.h"

namespace kagefude {

/// Depths seen from a light. The light's camera looks along its -Z; a texel holds the planar depth
/// -z (light space, world units) of the nearest surface at the texel's centre. Background is a huge
/// depth. clipFromLight may be perspective or orthographic; row 0 of the map is clip y = +1.
struct ShadowMap {
  View<const float> depth;
  Transform lightFromWorld;
  Transform clipFromLight;
};

}  // namespace kagefude
