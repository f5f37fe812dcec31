#pragma once

#include <string>
#include <vector>

#include "passes/casters/camera_rays.h"
#include "passes/casters/caster_set.h"

namespace kagefude {

/// What a frame's light would meet: the casters in world space, the tree over them, and the rays of
/// the camera that sees the result.
struct CastingScene {
  std::vector<CasterMesh> meshes;  ///< ids as in the frame's object ids
  CasterSet set;
  CameraRays rays;
  std::vector<std::string> warnings;
};

struct FramePlan;

/// The rays of the camera that sees a planned frame. Throws InputError without a sidecar.
CameraRays raysOf(const FramePlan& plan);

/// Reads the casters of a planned frame and builds what the methods need. Without casters only the
/// rays are filled. Throws InputError.
CastingScene readCastingScene(const FramePlan& plan);

}  // namespace kagefude
