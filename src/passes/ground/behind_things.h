#pragma once

#include "passes/edges/coverage_blend.h"

namespace kagefude {

/// **[ours]** A picture as it may look behind things: pixels where `open` is 1 are taken over, all
/// others take the colour of the nearest open one (the smaller y, then the smaller x of equally
/// near ones); nothing, where none is open. picture: associated; its alpha may be empty, which is
/// 1. Cost: one nearest-site search.
ColourPlanes extendBehindThings(const ColourViews& picture, View<const uint8_t> open);

/// The open pixel nearest to (x, y), as nearestOpen gives it; noSite where none is within three
/// pixels.
uint32_t openNearby(View<const uint8_t> kinds, uint8_t open, int x, int y);

/// The open pixel that stands behind each that is wanted, as y * width + x; noSite where none is
/// open. kinds: a pixel of the kind `open` is open, one of the kind `wanted` wants it.
Labels nearestOpen(View<const uint8_t> kinds, uint8_t open, uint8_t wanted);

}  // namespace kagefude
