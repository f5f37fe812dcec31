#pragma once

#include <array>
#include <span>

#include "base/parameter.h"
#include "image/plane.h"
#include "passes/casters/caster_set.h"
#include "passes/casters/seen_surface.h"
#include "passes/casters/shadow_wedges.h"

namespace kagefude {

struct VolumeParams {
  bool subpixels = true;
  float bias = 0.002f;  ///< pixels
};

inline constexpr std::array volumeParameters = {
    plain<&VolumeParams::subpixels>(
        "subpixels", "Counts at 8x8 sub-pixels; off counts once at the pixel's centre."),
    number<&VolumeParams::bias>(
        "bias", 0, 10, "rendered pixels",
        "How far towards the camera the surface is lifted before counting."),
};

inline constexpr ParameterTable volumeTable = {
    "volume", "Hard shadows by counting the faces of extruded silhouettes before the surface.",
    "003", volumeParameters};

/// Share of each pixel in shadow, 0 to 1, by the lecture's shadow volumes (003): silhouette edges
/// are extruded away from the light, and along the line of sight each face that leads into a
/// volume adds and each that leads out subtracts; what is left before the surface decides.
///
/// Where it departs from the lecture: every triangle is turned to face the light and its volume's
/// sides cancel against its neighbours', so that edges left over are silhouettes of closed meshes,
/// borders of open ones, and whatever else bounds the shadow of a mesh that is neither; the count
/// starts with the volumes that the camera itself is in, which the lecture leaves unsolved.
/// Faces that share an edge judge it by numbers that differ in sign alone, so no ray slips between.
///
/// Needs the meshes and the set made of them. Own shadows are kept. Background is 0. Independent
/// of shadowCoverage but for the surface at the sub-pixels, and slower: it is the check on it.
/// Cost: about five times shadowCoverage on meshes of 32 and 2,000 triangles, more on large ones.
/// Throws InputError when planes differ in size.
Floats shadowVolume(const SeenSurface& surface, std::span<const CasterMesh> meshes,
                    const CasterSet& casters, const LightPlace& light, const VolumeParams& params);

/// Edges of the volume's sides for one mesh: the silhouette as seen from the light, and borders.
/// Each pair of corners is directed so that the shadow lies to its left seen from the light;
/// weight counts how many triangles' volumes end there.
struct SilhouetteEdge {
  V3f a, b;
  int weight;
};
std::vector<SilhouetteEdge> silhouetteEdges(const CasterMesh& mesh, const LightPlace& light);

}  // namespace kagefude
