#pragma once

#include <span>

#include "compositor/frame_plan.h"
#include "compositor/write_frame_picture.h"
#include "look/look.h"

namespace kagefude {

/// Bytes that a frame holds while it is in flight, at most: the largest of its reading, its
/// composition and its writing, which follow each other, by as many threads as the current arena
/// has. tests/e2e/memory_long.sh holds it against the resident memory of whole runs; the program
/// itself (about 35 MB with the strips) is not in it. `pictures` are written one after the
/// other, beside the EXR or without one. Cost: the headers of depth maps.
size_t frameMemory(const Look& look, const FramePlan& plan,
                   std::span<const PictureOutput> pictures);

}  // namespace kagefude
