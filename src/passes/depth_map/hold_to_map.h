#pragma once

#include <span>

#include "passes/depth_map/back_projection.h"
#include "passes/light_shape/light_shape.h"

namespace kagefude {

/// Takes the visibility of a depth map thrown back on the light (back_projection.h) into what masks
/// gave, at and within four pixels of where they were unsure, as far as the masks bear the map out:
/// its weight is 1 where every mask sees what the map says of its place, falling to 0 where a third
/// of them do not, as a mean over 7 x 7 pixels of the surface, and at a pixel itself from a tenth
/// to 43 %. Where both give about the same (to nothing at 0.25 apart) both count, K masks K² / (K²
/// + 20²), and where the light grazes (to nothing at a cosine of 0.7) K² / (K² + 5²). The map holds
/// thin shadows that lie between the masks' places, and wide ones without steps; the masks hold
/// what touches its receiver, and edges finer than the map's texels. Where no mask sees the light
/// at most 0.08 of it is taken from the map.
///
/// masks: those of which `shape` was made; a round light's. Others as backProject. Confidence rises
/// with the map's weight. Cost: backProject's, and a mean over a window.
void holdToMap(std::span<const PlacedMask> masks, Vec3View position, Vec3View normal,
               View<const uint32_t> surfaces, const ShadowMap& map, float lightRadius,
               LightShapeResult& shape);

}  // namespace kagefude
