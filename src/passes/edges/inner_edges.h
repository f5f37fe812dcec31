#pragma once

#include "image/vec.h"
#include "passes/casters/camera_rays.h"
#include "passes/edges/behind_paint.h"
#include "passes/tone/surfaces.h"

namespace kagefude {

/// What is known of the surfaces that a picture shows.
struct EdgeSurfaces {
  View<const uint32_t> ids;          ///< objects, 0 = background
  View<const uint16_t> styles;       ///< what paints each pixel; another one is an edge too
  View<const uint8_t> joins;         ///< JoinedWay, as labelSurfaces keeps them
  Vec3View normal, position;         ///< world
  const CameraRays* rays = nullptr;  ///< null: not known
  bool betweenObjects = false;       ///< whether edges from one object to another are blended here
};

/// **[ours]** Clean edges inside objects, of one sample a pixel: every pixel's colour was made for
/// the surface at its centre; here a pixel of an edge gives the share of its square in which the
/// surfaces of its neighbours are seen to their colours. Where two surfaces meet in a crease, their
/// tangent planes say where it runs, to a fraction of a pixel (creaseLine), and the square is cut
/// by it exactly; corners, where several meet, by all of them. Where one surface hides the other,
/// and at borders of paint, the staircase of the edge tells its slope (stairShare). Pixels away
/// from edges are not touched. paint: in place, scene-linear, associated. Cost: a look at every
/// pixel's joins, some hundred operations at an edge.
void blendInnerEdges(const EdgeSurfaces& surfaces, const PaintViews& paint);

}  // namespace kagefude
