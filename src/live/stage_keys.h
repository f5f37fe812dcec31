#pragma once

#include "compositor/frame_plan.h"
#include "live/stage_key.h"

namespace kagefude {

// What stages depend on beside the versions of their inputs, for keys. Each names everything that
// its stage's functions take from look and plan; a new parameter of a pass is in by its table.

/// A file as it lies on disk: path, time of change, size and inode. One that is not there has a
/// stamp as well.
void addFile(StageKey& key, const std::filesystem::path& file);

/// What readFramePlanes takes: the files, the channels, and what casters are told of names.
void addReading(StageKey& key, const Look& look, const FramePlan& plan);

/// What a light's method takes to find its visibility, before smoothing. Parameters of all methods
/// count, whichever is in use: a method never misses one.
void addShadow(StageKey& key, const FramePlan& plan, const FrameLight& light);

/// The light itself: kind, place and size.
void addLight(StageKey& key, const FrameLight& light);

/// By what a light counts in the tone.
void addWeight(StageKey& key, const FrameLight& light);

/// Which strokes each surface gets (styleSurfaces): lights, scene, and each style's brush; without
/// what only colours them afterwards (outlines, tone, albedo).
void addStrokes(StageKey& key, const Look& look, const FramePlan& plan);

/// The rest of what styleSurfaces takes.
void addStyleColours(StageKey& key, const Look& look);

}  // namespace kagefude
