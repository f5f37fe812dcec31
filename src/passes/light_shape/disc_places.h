#pragma once

#include <vector>

#include "image/vec.h"

namespace kagefude {

/// Places of `count` (5 or more) masks on a light's disc, in radii: its centre, then up to eight
/// round its rim in turning order, then further groups of eight that fill the widest gaps, so that
/// discs of 9, 17, 33 and 65 contain each other. Counts between spread their last group evenly.
std::vector<V2f> discPlaces(int count);

}  // namespace kagefude
