#pragma once

#include <string>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// The values of a layer: one of the two.
struct LayerPlane {
  Floats floats;
  Labels labels;
};

/// A layer beside the picture, under the name that it gets in the file.
struct NamedPlane {
  std::string name;
  LayerPlane plane;
};

/// A composited frame in the working space, alpha associated, one value a pixel of the data window
/// that is written (see scale_down.h).
struct FrameResult {
  Vec3Plane colour;
  Floats alpha;
  std::vector<NamedPlane> layers;
  std::vector<bool> fittingStyles;    ///< each style of the look: whether it fits something seen
  std::vector<bool> paintingStyles;   ///< and whether it paints some of it
  std::vector<bool> outrankedStyles;  ///< and whether one of higher priority paints some of it
  Labels standing;  ///< Downscale::standing of the surfaces; empty at output.scale = 1
  std::vector<std::string> warnings;
};

}  // namespace kagefude
