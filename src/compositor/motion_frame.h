#pragma once

#include <map>
#include <string>

#include "compositor/frame_plan.h"
#include "passes/measure/warp_error.h"

namespace kagefude {

/// What of a rendered frame is needed to follow its surfaces to the frame before.
struct MotionFrame {
  Labels ids;
  Vec3Plane position;
  Vec3Plane rest;           ///< x is NaN where the pass holds nothing; empty without one
  Floats motionX, motionY;  ///< pixels to the previous frame's place, y upward
  std::map<uint32_t, Transform> worldFromObject;  ///< of the objects that a sidecar describes
  std::map<uint32_t, std::string> names;          ///< of the objects that anything names
  std::optional<Transform> cameraFromWorld, clipFromCamera;
  std::optional<Sidecar> sidecar;
  Window dataWindow, displayWindow;
};

/// Reads object ids, positions and motion vectors of a frame. Throws InputError that names what is
/// missing.
MotionFrame readMotionFrame(const Look& look, const std::filesystem::path& path, int frame);

/// Where every pixel's surface was in the frame before: findPreviousPlaces, with occlusions within
/// one object found by its rest positions, where both frames have them, for skin that deforms and
/// instances keep theirs. Of other objects by moving each position back with the object's matrices;
/// one that has none in both frames is taken to have stood still. Without rest and sidecars: by ids
/// alone. Throws InputError when the frames differ in size.
PreviousPlaces previousPlaces(const MotionFrame& now, const MotionFrame& before);

}  // namespace kagefude
