#pragma once

#include <optional>

#include "passes/casters/camera_rays.h"
#include "passes/edges/pixel_cut.h"

namespace kagefude {

/// A surface as one pixel shows it: its tangent plane.
struct SurfacePoint {
  V3d position;  ///< relative to the rays' eye
  V3d normal;    ///< of any length and either side
};

/// Where the surface at a neighbour is seen instead of a pixel's own, as a half plane round the
/// centre of pixel (x, y): the two tangent planes meet in a line, and a line is straight in the
/// picture (inverse depth of a plane is linear in a pixel's place under perspective, depth under a
/// parallel one). Holds for convex and hollow creases alike: of the two depths that surface is seen
/// which is seen at its own centre. (stepX, stepY) leads to the neighbour.
/// Nothing when the planes do not change places between the two centres (one surface hides the
/// other), when one is seen edge-on, or when a value is not finite.
std::optional<HalfPlane> creaseLine(const SurfacePoint& own, const SurfacePoint& other,
                                    const CameraRays& rays, int x, int y, int stepX, int stepY);

}  // namespace kagefude
