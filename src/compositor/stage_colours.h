#pragma once

#include "image/vec.h"
#include "passes/search/classes.h"

namespace kagefude {

// How planes that are no pictures are shown, on sheets and on the page.

/// A bright, distinct colour for a label: hues spread by the golden ratio over hashed labels; 0 is
/// black.
V3f labelColour(uint32_t label);

/// Umbra nearly black, penumbra amber, lit white, background grey.
V3f classColour(ShadowClass shadow);

/// A unit vector as 0.5 + 0.5 n.
inline V3f directionColour(const V3f& direction) { return direction * 0.5f + V3f(0.5f); }

}  // namespace kagefude
