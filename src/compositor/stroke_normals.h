#pragma once

#include "compositor/frame_planes.h"
#include "compositor/styled_surfaces.h"

namespace kagefude {

/// Normals that strokes take their directions from, where a style asks for smooth ones
/// (brush.smooth_normals): the mean within each surface over a window as wide as that share of the
/// strip where it stands, unit; others as they are. Windows are whole powers of the root of two, so
/// that a frame is averaged a few times only, and 513 pixels wide at most. Empty where no style
/// asks, or the camera is not known. Cost: one average of three planes for each width.
Vec3Plane strokeNormals(const FramePlanes& planes, const StyledSurfaces& styled,
                        View<const uint32_t> surfaces);

/// Whether a style asks for any.
bool smoothsNormals(const StyledSurfaces& styled);

}  // namespace kagefude
