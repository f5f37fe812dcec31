#pragma once

#include <span>

#include "passes/edges/coverage_blend.h"
#include "passes/edges/inner_edges.h"

namespace kagefude {

/// What is known of the surfaces in a picture whose render kept mean normals.
struct MeanNormalEdges {
  EdgeSurfaces surfaces;
  View<const uint32_t> ownId;           ///< each pixel's own thing in the ranks' ids
  std::span<const CoverageRank> ranks;  ///< Cryptomatte
  Vec3View mean;  ///< world; over all samples of the pixel, of what shows nothing 0
};

/// **[ours]** Clean edges of one sample a pixel, by what a render of many samples knows beside its
/// coverage: the mean of the normals that each pixel saw, through the same filter. Of a rim thinner
/// than a pixel the centres hit only some, as dashes; its normals however are in the mean of every
/// pixel that it crosses. Each pixel gets the mixture of its 3x3's colours whose normals have that
/// mean and whose things have their coverage (blendByCoverage): least squares with shares of 0 and
/// more, near the mixture that is known without it, i.e. coverage and, within a thing,
/// blendInnerEdges. Where that leaves much of the mean unexplained, up to two pixels of its things
/// join, no more than 8 away, where dashes of the same line may lie. Where the normals say nothing,
/// as at a border of materials, it is the mixture without them; coverage, and so alpha, is kept
/// exactly. A thing without pixels in the 3x3 lends the mean of the nearest square up to 17x17
/// that has some (blendByCoverage ends at 5x5). Next to surfaces that are not painted, and where
/// the mean is not finite, nothing is known of the rest of the mean, so the mixture without it
/// stands.
///
/// paint: as it was painted for each pixel's centre. Where one surface covers a pixel and the
/// mean is its normal, colours keep their bits. Cost: some thousand operations at a
/// pixel of an edge, ten thousand where it looks farther away.
void blendByMeanNormals(const PaintViews& paint, const MeanNormalEdges& edges);

}  // namespace kagefude
