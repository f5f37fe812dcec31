#pragma once

#include <string>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// A float layer beside the picture, under the name that it gets in the file.
struct NamedPlane {
  std::string name;
  Floats plane;
};

/// A composited frame in the working space, alpha associated, one value a pixel of the data window.
struct FrameResult {
  Vec3Plane colour;
  Floats alpha;
  std::vector<NamedPlane> layers;
  Labels surfaceId;                 ///< empty unless asked for
  std::vector<bool> fittingStyles;  ///< each style of the look: whether it fits something seen
  std::vector<std::string> warnings;
};

}  // namespace kagefude
