#pragma once

#include "passes/light_shape/light_shape.h"

namespace kagefude {

/// **[ours]** About how far the visibility that a disc's masks give is from the truth: the root
/// mean square over the penumbra of the change that the last half of the masks makes, for discs of
/// 9, 17, 33 and 65 contain the next smaller one (disc_places.h). Each disc's error is about
/// independent of the next smaller one's and some 0.7 of it, so that their difference is about the
/// error that is left: within a third of it on the ten scenes of tests/quality/run.sh.
///
/// The arguments are lightShapeVisibility's. Penumbra: where either disc gives 0.02 to 0.98.
/// Nothing where the masks are no such disc or there is no penumbra. Cost: two calls of
/// lightShapeVisibility.
std::optional<float> estimateDiscError(std::span<const View<const uint8_t>> masks,
                                       std::span<const V2f> places, View<const uint32_t> labels,
                                       Vec3View position, Vec3View normal,
                                       const std::optional<LightGeometry>& geometry,
                                       const LightShapeParams& params);

/// How many masks of a disc would leave no more than `wanted` where `count` of them leave `error`;
/// 0 where 65 would not do.
int masksFor(float wanted, int count, float error);

}  // namespace kagefude
