#pragma once

#include "frame/aov_resolver.h"

namespace kagefude {

/// The exporter's mean of the normals that all samples of a pixel saw, in world space. It lies
/// beside the frame's own normals and nowhere else, so no look names it.
struct MeanNormalPass {
  std::string name;                   ///< "data.MeanNormal"; "" when no channel of it is there
  std::vector<std::string> channels;  ///< those of X, Y, Z that are there
  std::string fault;                  ///< why it cannot be used, in a sentence; "" when it can
};
MeanNormalPass findMeanNormal(const ImageFile& file, const Aov& normal);

}  // namespace kagefude
