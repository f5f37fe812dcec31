#pragma once

#include "compositor/frame_plan.h"
#include "exr/read_channels.h"

namespace kagefude {

/// Finds the positions' pass; failing that the depth that positions are rebuilt from, with a
/// warning that says so. `plan.spaces` must hold the camera. InputError when neither will do, with
/// what is missing of both.
void planPositions(const AovNames& names, FramePlan& plan);

/// A frame's positions as they are read: those of its pass, or the depth that they are rebuilt
/// from.
struct PositionPass {
  Vec3Plane given;
  Floats depth;
};

/// Asks for them; both planes must live until the reader has read.
void requestPositions(ChannelReader& reader, const FramePlan& plan, PositionPass& pass);

/// The positions, once the reader has read: as the pass has them (convertToWorld is still to come),
/// or rebuilt in world space.
Vec3Plane takePositions(const FramePlan& plan, PositionPass& pass);

/// Nothing is seen where there is no depth that a position could be rebuilt from: ids become 0
/// there. InputError where that leaves nothing of what the ids show, a warning where it takes more
/// than edges do (5 %). Nothing for positions that were not rebuilt.
void clearWithoutDepth(const FramePlan& plan, FramePlanes& planes);

}  // namespace kagefude
