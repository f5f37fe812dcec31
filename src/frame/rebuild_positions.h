#pragma once

#include <string>

#include "exr/image_file.h"
#include "frame/aov_resolver.h"
#include "frame/frame_camera.h"
#include "frame/vector_spaces.h"
#include "image/vec.h"

namespace kagefude {

/// What keeps positions from being rebuilt with the frame's camera, as the end of a sentence; ""
/// when nothing does.
std::string rebuildFault(const VectorSpaces& spaces);

/// World positions from a depth pass: each pixel's centre, seen by the camera, at that depth along
/// the camera's axis (planar) or along the pixel's own ray, in the camera's units; for a parallel
/// camera both are the same. Depths that are 0, negative, infinite or above 9e9 are background
/// (Blender writes 1e10, others infinity or 1e30) and give 0; NaN gives NaN.
///
/// `file` says where the planes lie in the display window, which clip space spans. Throws
/// InputError when no pixel has a depth above 0 though some are below, the camera is not known
/// whole, or it stands so far from the world's origin that the floats there are farther apart than
/// most of the pixels. Cost: about 20 operations a pixel.
Vec3Plane rebuildPositions(View<const float> depth, const VectorSpaces& spaces,
                           const ImageFile& file);

/// The same pixels, had their depth been measured along the other of planar and ray: moves each
/// rebuilt position along its ray.
Vec3Plane rebuiltOtherwise(Vec3View position, const VectorSpaces& spaces);

/// Holds rebuilt positions against the normals (world space). Where the other kind of depth fits
/// them better beyond chance, that is known and named; if the look says which kind it is, it is
/// only said. Of planar depth the camera's angle of view is doubted too, where one that is 5 % or
/// more off fits better. Bumps hide little, for places are compared pair by pair. Nothing for
/// positions that were not rebuilt, and for parallel cameras. Cost: that of rebuilding them.
SpaceDoubt doubtDepth(const VectorSpaces& spaces, Vec3View position, Vec3View normal,
                      View<const uint32_t> ids);

}  // namespace kagefude
