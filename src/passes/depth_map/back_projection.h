#pragma once

#include <span>

#include "passes/depth_map/shadow_map.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {

/// A hard mask of the same light. mask: 0 = the light is hidden from that place, else seen.
struct PlacedMask {
  View<const uint8_t> mask;
  V3f offset{0, 0, 0};  ///< of its place from the light's centre, world; a sun's: of the way to it
};

struct BackProjection {
  Floats visibility;
  Bytes contradicted;  ///< how many masks see what the map does not say of their places
};

/// What of a round light can be seen, by throwing a depth map back on it: each texel nearer to the
/// light than the receiver is a small square that faces the light, and hides from a point what lies
/// behind it, drawn as a rectangle on the light's disc (Guennebaud, Barthe & Paulin 2006); 256
/// points of the disc are marked (Schwarz & Stamminger 2007), so blockers before one another are
/// counted once. Between neighbouring texels that both hide something the rectangles grow until
/// they meet, so a slanted surface has no gaps. What lies below the receiver's own horizon is
/// hidden.
///
/// position, normal: world; normals may not be empty. labels: 0 = background, visibility 1. map: as
/// the light's centre sees it. lightRadius: world units, of a sphere; for an orthographic map (sun)
/// the tangent of half its angle. masks: held against the map, none or up to mostMasks. wanted: 0 =
/// the pixel is passed over, visibility 1; empty: all are wanted.
///
/// A texel blocks when it stands above the receiver's tangent plane by more than `bias` texel
/// widths at the receiver and 0.03 of its distance: lower ones are the receiver's own, rounded
/// (hides at most what stands 1.7 degrees above the horizon). So blockers that touch are lost by
/// half a texel; masks tell (pair_depth.h).
/// Only what the centre sees is known: what stands behind it hides nothing. Squares reach at most
/// 512 texels round the receiver. Outside the map, behind the light, NaN: lit.
/// Frames of more than 512 x 512 pixels have every fourth pixel of every fourth row first, of more
/// than 2048 x 2048 every eighth, then all at half those distances, and so on; between four of one
/// surface that differ by less than 0.1 is interpolated.
/// Throws InputError when sizes differ, the map is empty or masks are more than mostMasks. Cost:
/// one read of a pixel's window of the map, as wide as the light's shadow through the nearest
/// blocker there: 2 ns a texel.
BackProjection backProject(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                           const ShadowMap& map, float lightRadius, float bias,
                           std::span<const PlacedMask> masks, View<const uint8_t> wanted = {});

}  // namespace kagefude
