#pragma once

#include "passes/edges/coverage_blend.h"

namespace kagefude {

/// **[ours]** A picture as it may look behind things: pixels where `open` is 1 are taken over, all
/// others take the colour of the nearest open one (the smaller y, then the smaller x of equally
/// near ones); nothing, where none is open. picture: associated; its alpha may be empty, which is
/// 1. Cost: one nearest-site search.
ColourPlanes extendBehindThings(const ColourViews& picture, View<const uint8_t> open);

}  // namespace kagefude
