#pragma once

#include "frame/inspect_frame.h"
#include "look/look.h"

namespace kagefude {

/// Adds to what was found in a frame's headers what a comp would say of its lights' depth maps and
/// of what they are held against: maps that do not fit their light's masks, or cannot be read.
/// `names` says which passes the frame has. Nothing is added where no light has a map that a comp
/// reads, or the headers lack what a comp needs, which inspectFrame says. Cost: reads positions,
/// normals, ids, masks and maps.
void inspectDepthMaps(const AovNames& names, Inspection& inspection);

}  // namespace kagefude
