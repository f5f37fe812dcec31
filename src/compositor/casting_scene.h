#pragma once

#include <optional>
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

/// The rays of the camera that sees a planned frame. Where that is not known, or is no camera:
/// throws InputError when they are `needed`, else nothing.
std::optional<CameraRays> raysOf(const FramePlan& plan, bool needed);

/// Reads the casters of a planned frame, which has a sidecar, and builds what the methods need.
/// Throws InputError.
CastingScene readCastingScene(const FramePlan& plan);

}  // namespace kagefude
