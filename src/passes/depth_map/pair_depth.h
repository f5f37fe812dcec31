#pragma once

#include "base/parameter.h"
#include "passes/depth_map/shadow_map.h"
#include "passes/light_shape/horizon.h"
#include "passes/search/pair_search.h"

namespace kagefude {

struct PairDepthParams {
  float lightSize = 1.0f;                   ///< share of the light's radius
  float bias = 0.5f;                        ///< texel widths at the receiver
  SearchBound bound = SearchBound::object;  ///< what the search between the masks must not leave
};

inline constexpr Parameter pairDepthParameters[] = {
    number<&PairDepthParams::lightSize>("light_size", 0, 4, "of the light", "Radius of the light."),
    number<&PairDepthParams::bias>("bias", 0, 100, "texels",
                                   "Height over a receiver's own plane from which the map's "
                                   "surfaces hide the light, in texel widths at the receiver."),
    choice<&PairDepthParams::bound>(
        "bound", searchBoundNames,
        "What the search between the masks must not leave: nothing, the object, or the smoothly "
        "connected surface."),
};
inline constexpr ParameterTable pairDepthTable{
    "pair_depth", "Visibility from the light's depth map, held to two hard masks.",
    "000 chapter 3; Guennebaud, Barthe & Paulin 2006; Schwarz & Stamminger 2007",
    pairDepthParameters};

/// Two hard masks of a round light, 0 = hidden, and where they stand on its axis.
struct MaskPair {
  View<const uint8_t> farMask, nearMask;
  PairLight light;
};

/// Visibility from a depth map thrown back on the light (back_projection.h), where both masks see
/// what the map says of their places; where they do not, from the search between them
/// (pair_search.h, with the receiver's horizon). The map knows how far each blocker stands, hence
/// how wide its penumbra is, but loses what touches the receiver; the masks know that to the pixel.
///
/// One mask contradicted beside an edge that the map has too (its share is neither 0 nor 1): an
/// edge of the map off by part of a texel; the map's share is kept. One contradicted elsewhere: the
/// mean of both. Both contradicted: the search.
/// labels: as pairVisibility takes them; surfaces: smoothly connected ones. Others as backProject
/// and pairVisibility. A light of another size (light_size) is checked against the masks at the
/// places where they were rendered. Cost: of both.
Floats pairDepthVisibility(const MaskPair& masks, Vec3View position, Vec3View normal,
                           View<const uint32_t> labels, View<const uint32_t> surfaces,
                           const ShadowMap& map, const PairDepthParams& params);

}  // namespace kagefude
