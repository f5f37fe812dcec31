#pragma once

#include "passes/edges/coverage_blend.h"
#include "passes/ground/painted_sky.h"
#include "passes/strip/strip.h"

namespace kagefude {

/// A picture behind things: as large as fills the display window, its shape kept, what is too much
/// cut off equally at both sides. `picture` is held as strips are, with its filtered copies; its
/// last pixels reach half a pixel beyond its edges. Scene-linear, associated. Cost: a filtered
/// lookup a pixel.
ColourPlanes fitPicture(const Strip& picture, const SkyView& view);

}  // namespace kagefude
