#pragma once

#include "frame/inspect_frame.h"
#include "look/look.h"

namespace kagefude {

/// Adds to what was found in a frame's headers what its pixels tell: coverage and mean normals that
/// cannot be, and of lights masks that are damaged or cut off and depth maps that do not fit them
/// or cannot be read, as a comp would say; and discs of masks that are too few for their shadows
/// (estimateDiscError) and have no map to help them, with how many would do. `names` says which
/// passes the frame has. Nothing is added where the headers lack what a comp needs, which
/// inspectFrame says. Cost: reads positions, normals, ids, coverage, masks and maps; two shadows a
/// light without a map.
void inspectLights(const AovNames& names, Inspection& inspection);

}  // namespace kagefude
