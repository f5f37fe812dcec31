#pragma once

#include <cstdint>

#include "base/parameter.h"
#include "image/vec.h"

namespace kagefude {

struct OutlineParams {
  float width = 1.5f;
  float depthStep = 0.02f;
  float creaseAngle = 50;
  bool objects = true;
};

inline constexpr Parameter outlineParameters[] = {
    number<&OutlineParams::width>("width", 0.1, 64, "pixels", "Width of the lines."),
    number<&OutlineParams::depthStep>("depth_step", 0, 10, "of the depth",
                                      "Step from one surface to another of the same object, "
                                      "beside the surface's own plane, that draws a line; 0 draws "
                                      "none."),
    number<&OutlineParams::creaseAngle>("crease_angle", 0, 180, "degrees",
                                        "Angle between neighbouring normals that draws a line; "
                                        "180 draws none."),
    plain<&OutlineParams::objects>("objects", "Draw a line round every object."),
};
inline constexpr ParameterTable outlineTable{"outline",
                                             "Contour lines from id, depth and normal edges.",
                                             "003, contour lines", outlineParameters};

struct OutlineResult {
  Floats coverage;  ///< share of the pixel that the line covers, 0..1
  Labels owner;     ///< id of the nearest surface at the line, whose style it takes; 0: no line
};

/// Contour lines in the image (003 draws silhouette edges of the mesh; here they are found between
/// pixels). Two neighbours lie on different sides of a line when their ids differ, when one lies
/// off the other's tangent plane by more than depth_step x depth, or when their normals differ by
/// more than crease_angle. A lip, which lies no more than two pixels from a line between ids to a
/// crease, has no line of its own. **[ours]** Smooth lines from ids without anti-aliasing: round
/// each such pixel the share of its side in a Gaussian window tells how far off, to a fraction of a
/// pixel, the smoothed boundary runs and which way; a short piece of line of the asked width is
/// drawn there. ids: 0 = background. depth: distance from the camera or planar depth, world units;
/// only compared. Any of normal and position may be empty: then ids alone count. Background pixels'
/// normals and positions are not read. Cost: 49 comparisons an edge pixel, and the line's area.
OutlineResult drawOutlines(View<const uint32_t> ids, Vec3View normal, Vec3View position,
                           View<const float> depth, const OutlineParams& params);

}  // namespace kagefude
