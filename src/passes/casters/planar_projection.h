#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/parameter.h"
#include "image/plane.h"
#include "passes/casters/caster_mesh.h"
#include "passes/casters/seen_surface.h"
#include "passes/casters/shadow_wedges.h"

namespace kagefude {

struct PlanarParams {
  float alpha = 0.5f;
};

inline constexpr std::array planarParameters = {
    number<&PlanarParams::alpha>("alpha", 0, 1, "", "Opacity of the shadow."),
};

inline constexpr ParameterTable planarTable = {
    "planar", "Casters projected on a flat receiver along the light, drawn once per pixel.", "003",
    planarParameters};

/// A flat receiver in world space, with a unit normal.
struct ReceiverPlane {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};
};

/// The plane through the mean position of the pixels with the ID, along their mean normal. Throws
/// InputError, naming `receiver`, when no pixel has the ID or one lies farther from the plane than
/// a hundredth of the receiver's extent: it is not flat.
ReceiverPlane planeOfReceiver(const SeenSurface& surface, uint32_t id, const std::string& receiver);

/// The parts of the casters between the light and the plane, flattened onto it along the light
/// (the projection matrix of 003, for any plane and a light at a place or far away). What lies
/// beyond the plane or beyond the light is clipped, not mirrored. Empty when the light shines along
/// the plane.
std::vector<CasterMesh> projectedOnPlane(std::span<const CasterMesh> casters,
                                         const ReceiverPlane& plane, const LightPlace& light);

/// Opacity of the flat shadow at each pixel of the receiver, 0 to alpha: of the 8x8 sub-pixels that
/// show the receiver, the share whose ray passes through a flattened caster. Sub-pixels that show
/// a caster before it count nowhere, or a caster's own foot would darken its outline. A sub-pixel
/// counts once however many triangles cover it, as with the lecture's stencil. Casters with the
/// receiver's own ID are left out; other pixels are 0. The visibility is 1 - a; the strip gives
/// the shadow its colour. `set` holds the casters.
Floats planarShadow(const SeenSurface& surface, uint32_t receiverId, const ReceiverPlane& plane,
                    std::span<const CasterMesh> casters, const CasterSet& set,
                    const LightPlace& light, const PlanarParams& params);

}  // namespace kagefude
