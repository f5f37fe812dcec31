#include "passes/depth_map/pair_depth.h"

#include "image/parallel.h"
#include "passes/depth_map/back_projection.h"

namespace kagefude {
namespace {

constexpr float leastEdge = 0.02f;  ///< a share between it and 1 less it is an edge's

float heldTo(float fromMap, float fromMasks, int contradicted) {
  const bool onEdge = fromMap > leastEdge && fromMap < 1 - leastEdge;
  if (contradicted == 0 || (contradicted == 1 && onEdge)) return fromMap;
  return contradicted == 1 ? (fromMap + fromMasks) / 2 : fromMasks;
}

}  // namespace

Floats pairDepthVisibility(const MaskPair& masks, Vec3View position, Vec3View normal,
                           View<const uint32_t> labels, View<const uint32_t> surfaces,
                           const ShadowMap& map, const PairDepthParams& params) {
  PairParams search;
  Floats fromMasks = pairVisibility(masks.farMask, masks.nearMask, labels, search);
  settleAtHorizon(masks.farMask, masks.nearMask, labels, position, normal, masks.light, fromMasks);
  const PlacedMask placed[] = {{masks.farMask, masks.light.towardsFar},
                               {masks.nearMask, -masks.light.towardsFar}};
  BackProjection back = backProject(position, normal, surfaces, map,
                                    masks.light.radius * params.lightSize, params.bias, placed);
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < labels.width; ++x)
        back.visibility(x, y) =
            heldTo(back.visibility(x, y), fromMasks(x, y), back.contradicted(x, y));
  });
  return std::move(back.visibility);
}

}  // namespace kagefude
