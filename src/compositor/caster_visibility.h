#pragma once

#include "compositor/frame_light.h"
#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"

namespace kagefude {

/// Reads the casters of a planned frame and builds what the methods below need. Without casters
/// only the rays are filled. Throws InputError.
CastingScene readCastingScene(const FramePlan& plan);

/// Visibility of a light from the shapes that cast its shadow: methods coverage (004), volume,
/// planar and blob (003).
Floats casterVisibility(const FrameLight& light, const FramePlan& plan, const FramePlanes& frame);

/// Hard masks from `light.castPlaces` places on the light's disc (or round a sun's direction), with
/// the places in units of the light's radius and what moves the light between them: the casters'
/// stand-in for masks that were rendered.
struct CastMasks {
  std::vector<Bytes> masks;
  std::vector<V2f> places;
  LightGeometry geometry;
};
CastMasks castMasks(const FrameLight& light, const FramePlanes& frame);

}  // namespace kagefude
