#pragma once

#include <optional>
#include <string>

#include "image/vec.h"

namespace kagefude::detail {

/// Clip space -1..1, y up, from a camera that looks along -z: x = (scaleX x) / -z + middleX.
Transform perspectiveClip(double scaleX, double scaleY, double middleX, double middleY);

/// What a matrix to a renderer's NDC turned out to be.
struct NdcProjection {
  std::optional<Transform> clipFromCamera;  ///< of a camera that looks along -z
  std::string fault;                        ///< why there is none, to follow its name
};

/// `ndcFromCamera` maps columns of the camera's own space, which looks along +z where
/// `looksAlongZ`, else along -z; x right, y up. `aspect`: of the whole picture, width over height.
/// `distance`: how far that space's origin is from the world's, by which rounding grows.
/// Refused are projections that mirror, whose pixels are not square within 1 %, whose axis meets
/// the picture so far off its middle (0.2 in its units) that 0..1 cannot be told from -1..1, and
/// what is no projection.
NdcProjection ndcProjection(const Transform& ndcFromCamera, bool looksAlongZ, double aspect,
                            double distance);

}  // namespace kagefude::detail
