#pragma once

#include "image/vec.h"

namespace kagefude {

/// Makes x NaN where a rest pass holds nothing: not finite, no alpha (where there is one), or 0, as
/// renderers leave it for what has no such attribute.
void markWithoutRest(View<const float> alpha, Vec3Plane& rest);

}  // namespace kagefude
