#pragma once

#include <cstddef>

#include "image/plane.h"
#include "image/vec.h"

namespace kagefude {

/// Turns pixels whose position or normal is not finite into background: position and normal 0 and,
/// where given, label 0. Returns how many pixels that were. Views may be empty (then skipped);
/// those given must be of one size. Cost: one pass.
size_t clearNonFinite(Vec3Plane& position, Vec3Plane& normal, View<uint32_t> labels = {});

/// Makes pixels of a picture black whose colour is not finite, and transparent where its alpha
/// (which may be empty) is not. Returns how many pixels that were. Cost: one pass.
size_t clearNonFiniteColour(Vec3Plane& colour, View<float> alpha = {});

/// Makes texels of a depth map that are no depth, NaN and -Inf, the 1e10 of nothing hit; +Inf is
/// that already, in halves and from some renderers. Returns how many those were.
size_t clearNoDepth(View<float> depth);

/// Replaces NaN and Inf by `background` and returns how many there were.
size_t clearNonFinite(View<float> plane, float background);

}  // namespace kagefude
