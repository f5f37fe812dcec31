#pragma once

#include "frame/sidecar.h"
#include "look/look.h"

namespace kagefude {

/// What a light's casters give: soft shadows where it has a size, else hard ones.
ShadowMethod casterMethod(float radius);

/// What shadow.method = "auto" takes of a light that the frame brings: its masks, which its depth
/// map helps where it is there and `mapHelps` (a pair's), else its traced shadow, its map, the
/// casters.
ShadowMethod automaticMethod(const SidecarLight& source, bool mapHelps, bool hasCasters,
                             float radius);

/// The same for a light that only the look describes; a map that it names must be there.
ShadowMethod automaticMethod(const LightParams& params, bool mapHelps, bool hasCasters);

}  // namespace kagefude
