#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"
#include "look/draft_look.h"

namespace kagefude {

/// Plans a frame so that its materials are known wherever it has names for them. Throws as
/// planFrame.
FramePlan planWithMaterials(Look look, const std::filesystem::path& path, int frame);

/// The tone of every pixel of a frame as a look without styles has it (frameTone).
Floats plainTone(const Look& look, const FramePlan& plan, const FramePlanes& planes);

/// The tone that a twentieth of the frame's surfaces exceed; 1 where there are none.
float brightTone(View<const float> tone, View<const uint32_t> objects);

/// The pairs of object and material that a frame shows, as a look is drafted from them: by the
/// number of their pixels, each with the median of its albedo, which knows no light, component by
/// component; where it has none (no pass, or black, as glass and metal are) with the median of the
/// brighter half of the beauty. Sizes of pixels are the median of the smaller distance to the
/// neighbours across and below. `tone` is plainTone's. Colours are in the working space. Cost: a
/// few sorts of each thing's pixels.
std::vector<DraftThing> seenThings(const FramePlan& plan, const FramePlanes& planes,
                                   View<const float> tone);

}  // namespace kagefude
