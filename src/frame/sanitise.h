#pragma once

#include <cstddef>

#include "image/plane.h"
#include "image/vec.h"

namespace kagefude {

/// Turns pixels whose position or normal is not finite into background: position and normal 0 and,
/// where given, label 0. Returns how many pixels that were. Views may be empty (then skipped);
/// those given must be of one size. Cost: one pass.
size_t clearNonFinite(Vec3Plane& position, Vec3Plane& normal, View<uint32_t> labels = {});

/// Replaces NaN and Inf by `background` and returns how many there were.
size_t clearNonFinite(View<float> plane, float background);

}  // namespace kagefude
