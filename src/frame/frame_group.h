#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kagefude {

/// One of several files that a frame consists of.
struct GroupFile {
  std::filesystem::path path;
  std::string layer;  ///< of its channels that have none
};

/// The files that the look's `frame.files` names beside a frame's own, for one frame and view, in
/// the look's order, without the frame's own. Patterns are those of FramePattern, relative to the
/// frame's folder. "N=shot_normals.####.exr" names the layer of bare channels; without a name it is
/// what the file's name has and the frame's does not: N for shot.N.####.exr beside shot.####.exr or
/// shot.beauty.####.exr, else the folder. Throws LookError for a pattern that is none.
std::vector<GroupFile> groupFiles(const std::filesystem::path& frame,
                                  const std::vector<std::string>& patterns, int number,
                                  const std::string& view);

}  // namespace kagefude
