#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exr/image_file.h"
#include "image/vec.h"

namespace kagefude {

/// The camera that saw a frame. Camera space is right-handed: x to the right of the picture, y up,
/// and the camera looks along -z. Clip space runs from -1 to 1 over the display window, y up.
struct FrameCamera {
  Transform cameraFromWorld;
  std::optional<Transform> clipFromCamera;  ///< absent: it is not known what a pixel looks along
  std::string source;                       ///< where it is known from, as messages say it
  std::string problem;      ///< why cameraFromWorld must not be used; "" when it may
  std::string clipProblem;  ///< why clipFromCamera is absent though the source speaks of it
  std::string doubt;        ///< what of it was guessed; "" when all is certain
};

/// The camera of the header (any own part's, the first that has one), as renderers write it:
///
/// - `worldToCamera` and `worldToNDC` (OpenEXR's ImfStandardAttributes.h; RenderMan, Arnold and
///   Mantra write them), also in OpenImageIO's spelling `worldtocamera`. OpenEXR says: a
///   left-handed camera space that looks along +z, an NDC of 0..1 over the display window with y
///   down, and, by Imath, row vectors. Files depart from all three, so all three are found out:
///   rows or columns by where the translation stands, else by which of them makes worldToNDC a
///   projection; the way that it looks by the determinant (a right-handed space looks along -z, as
///   in OpenGL); the NDC (0..1 or -1..1, y down or up) by where the axis meets the picture and by
///   the sign of y. Its depth may have either sign (Mantra's worldToNDC has -z for w in a space
///   that looks along +z).
/// - `cameraTransform` and `cameraFov` (V-Ray): world from a camera space that looks along -y with
///   -z up, and the full horizontal angle in degrees. Of `cameraProjection` only 0 is perspective.
///
/// Matrices of floats or doubles count. Where own parts (of a view, or of the files of a frame)
/// have different ones, and where only the default view's header has one, that is a `problem`.
/// What contradicts itself is a `problem`, never a guess; nothing is returned where no attribute of
/// these names is a matrix.
std::optional<FrameCamera> cameraOfHeader(const ImageFile& file);

/// Sixteen numbers, row by row.
Transform matrixFrom(const std::vector<float>& numbers);

}  // namespace kagefude
