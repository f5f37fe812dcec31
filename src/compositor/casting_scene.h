#pragma once

#include <string>
#include <vector>

#include "passes/casters/camera_rays.h"
#include "passes/casters/caster_set.h"

namespace kagefude {

/// What a frame's light would meet: the casters in world space and the tree over them.
struct CastingScene {
  std::vector<CasterMesh> meshes;  ///< ids as in the frame's object ids
  CasterSet set;
  std::vector<std::string> warnings;
};

struct FramePlan;

/// The rays of the camera that sees a planned frame. Throws InputError without a sidecar.
CameraRays raysOf(const FramePlan& plan);

/// Reads the casters of a planned frame, which has a sidecar, and builds what the methods need.
/// Throws InputError.
CastingScene readCastingScene(const FramePlan& plan);

}  // namespace kagefude
