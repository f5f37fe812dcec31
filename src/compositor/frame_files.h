#pragma once

#include <filesystem>
#include <vector>

#include "compositor/frame_plan.h"

namespace kagefude {

/// Every file that decides a frame's pixels beside the image and its JSON: its other files, depth
/// maps, the blob's pictures, casters' meshes and Cryptomattes' manifests, each once, in a fixed
/// order, whether they are there or not.
std::vector<std::filesystem::path> filesBeside(const FramePlan& plan);

}  // namespace kagefude
