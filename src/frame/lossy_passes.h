#pragma once

#include <string>
#include <vector>

#include "exr/image_file.h"

namespace kagefude {

/// A way in which a file's data passes have lost bits, and what to do about it; lower case.
struct LossyPass {
  std::string what;
  std::string remedy;
};

/// Data passes (positions, normals, depths, ids, vectors, Cryptomattes) in parts that are packed
/// with loss, and positions or ids of half precision. DWA quantises channels that end in R, G, B
/// or Y; PXR24 drops the last byte of every float; B44 packs half channels with loss. Looks at
/// headers only.
std::vector<LossyPass> lossyPasses(const ImageFile& file);

}  // namespace kagefude
