#pragma once

#include <cstddef>
#include <string>

#include "exr/image_file.h"
#include "image/plane.h"

namespace kagefude {

/// One channel each of two files, pixel on pixel: what both files' data windows cover.
struct ComparedPlanes {
  Floats value, truth;
  Floats where;           ///< pixels that count are not 0; empty: all do
  size_t background = 0;  ///< pixels that do not count because no object is there
  size_t outside = 0;     ///< pixels that only one of the two channels covers
};

/// Reads `channel` of a file and `truthChannel` of the file that holds the truth; each may be the
/// name of a layer with one channel. Planes lie by their data windows: a cropped or moved picture
/// is compared where it stands. Pixels count where `whereChannel`, a channel beside the truth, is
/// not 0. Without one (""), those without an object do not count, for there a visibility of 1 and a
/// truth of 0 mean the same: pixels whose Normal is 0, by the truth's file, else by the other;
/// where neither has normals, all count. Throws InputError when a channel does not exist (naming
/// the nearest), when the display windows have other sizes, or when nothing is covered by both.
ComparedPlanes readCompared(const ImageFile& file, const std::string& channel,
                            const ImageFile& truthFile, const std::string& truthChannel,
                            const std::string& whereChannel);

}  // namespace kagefude
