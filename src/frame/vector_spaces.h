#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exr/image_file.h"
#include "frame/aov_resolver.h"
#include "frame/frame_camera.h"
#include "frame/sidecar.h"
#include "image/vec.h"

namespace kagefude {

/// How a frame's positions and normals are read: what the look says of them, and the camera, which
/// those of camera space need.
struct VectorSpaces {
  VectorSpace position = VectorSpace::automatic;
  VectorSpace normal = VectorSpace::automatic;
  NormalRange range = NormalRange::automatic;
  std::string axes;
  DepthKind depthKind = DepthKind::automatic;
  bool rebuilt = false;               ///< positions come from depth, so they are in world space
  std::optional<FrameCamera> camera;  ///< the look's, else the JSON's, else the header's

  /// What to measure by where the look does not say.
  DepthKind measuredAlong() const {
    return depthKind == DepthKind::ray ? DepthKind::ray : DepthKind::planar;
  }
};

/// The look's settings and the frame's camera: the look's own, else `json`'s (null: none), else the
/// header's; a JSON's that is none, or of another view, stands behind the header's. LookError when
/// normal_axes are not x, y and z, each once, each with an optional minus, or the look's matrices
/// are no camera.
VectorSpaces vectorSpaces(const AovNames& names, const ImageFile& file, const Camera* json);

/// The camera, or an InputError that says why there is none; `needs` says what for.
const FrameCamera& requireCamera(const VectorSpaces& spaces, const ImageFile& file,
                                 std::string_view needs);

/// Turns positions and normals into world space in place; background stays 0. `window` and
/// `display` say where the planes lie in the picture: normals of a camera that neither JSON nor
/// header describes are turned by the camera that world positions and their pixels imply (linear
/// fit of a projection; needs a perspective view of something that is not one plane).
/// InputError when a camera is needed and there is none. With nothing set nothing changes.
void convertToWorld(const VectorSpaces& spaces, const ImageFile& file, Vec3Plane& position,
                    Vec3Plane& normal);

/// What speaks against the camera: "" when it is certain, or is not used by these spaces.
std::string doubtCamera(const VectorSpaces& spaces);

/// What speaks against the positions' and normals' being in world space, with normals of -1..1.
struct SpaceDoubt {
  bool known = false;    ///< a setting of the look explains and mends it
  std::string sentence;  ///< "" where nothing speaks against it
};

/// Holds normals against cross products of neighbouring positions of one thing at some 4,000
/// places, and positions against the camera where one is known. Normals that bumps or interpolation
/// bend keep their middle deviation below what is doubted (5 degrees); beyond it another reading is
/// named when it fits four times better: 0..1 decoded, the camera's space, axes flipped or swapped.
/// Nothing is said of frames with fewer than 64 usable places. Cost: about a millisecond.
SpaceDoubt doubtSpaces(const VectorSpaces& spaces, const ImageFile& file, Vec3View position,
                       Vec3View normal, View<const uint32_t> ids);

}  // namespace kagefude
