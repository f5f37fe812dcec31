#include "compositor/frame_edges.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/same_params.h"
#include "image/parallel.h"
#include "passes/edges/behind_paint.h"
#include "passes/edges/inner_edges.h"
#include "passes/edges/mean_normals.h"
#include "passes/edges/outline.h"
#include "passes/edges/painted_edges.h"

namespace kagefude {
namespace {

/// The Cryptomatte's id of each object that is painted, as they stand in `styled`.
std::vector<uint32_t> cryptomatteIdsOf(const FramePlan& plan, const StyledSurfaces& styled) {
  std::vector<uint32_t> ids(styled.objects.size(), 0u);
  for (size_t i = 1; i < ids.size(); ++i) ids[i] = plan.cryptomatteIdOf(styled.objects[i]);
  return ids;
}

/// Each pixel's own thing in the Cryptomatte's ids.
Labels ownCryptomatteIds(const FramePlan& plan, const StyledSurfaces& styled) {
  const View<const uint16_t> anchors = styled.anchorIndex;
  const std::vector<uint32_t> known = cryptomatteIdsOf(plan, styled);
  Labels ids(anchors.width, anchors.height);
  parallelRows(anchors.height, [&](int first, int end) {
    std::transform(anchors.row(first), anchors.row(end), ids.row(first),
                   [&](uint16_t anchor) { return known[anchor]; });
  });
  return ids;
}

std::vector<CoverageRank> coverageRanks(const FramePlanes& planes) {
  const CoveragePlanes& coverage = planes.coverage;
  std::vector<CoverageRank> ranks;
  if (!coverage.empty()) ranks.push_back({coverage.firstId, coverage.firstShare});
  for (size_t i = 0; i < coverage.otherIds.size(); ++i)
    ranks.push_back({coverage.otherIds[i], coverage.otherShares[i]});
  return ranks;
}

EdgeSurfaces edgeSurfaces(const FramePlanes& planes, const StyledSurfaces& styled,
                          View<const uint8_t> joins) {
  EdgeSurfaces surfaces{styled.objects, styled.anchorIndex, joins, planes.normal, planes.position};
  surfaces.rays = planes.rays ? &*planes.rays : nullptr;
  surfaces.betweenObjects = planes.coverage.empty();
  return surfaces;
}

/// Distances from the camera; only compared, so any depth along the view serves.
Floats cameraDistance(const FramePlan& plan, const FramePlanes& planes) {
  if (!plan.sidecar) return planes.depth.empty() ? Floats() : planes.depth.clone();
  const V3f eye(plan.sidecar->camera.position);
  Floats distance(planes.width, planes.height);
  parallelRows(planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < planes.width; ++x) {
        const V3f d = planes.position.view()(x, y) - eye;
        distance(x, y) = std::sqrt(d.dot(d));
      }
  });
  return distance;
}

/// Lines of the anchors in `own`, in the colour of their styles.
void paintLines(const OutlineResult& lines, const StyledSurfaces& styled,
                const std::vector<bool>& own, bool always, BrushResult& brush, View<float> all) {
  parallelRows(all.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < all.width; ++x) {
        const float share = lines.coverage.view()(x, y);
        const uint32_t owner = lines.owner.view()(x, y);
        if (share <= 0.0f || owner == 0 || owner > own.size() || !own[owner - 1]) continue;
        const auto& colour = styled.outlines[owner - 1].colour;
        if (colour || always) all(x, y) = std::max(all(x, y), share);
        if (!colour) continue;
        brush.r(x, y) += (colour->x - brush.r(x, y)) * share;
        brush.g(x, y) += (colour->y - brush.g(x, y)) * share;
        brush.b(x, y) += (colour->z - brush.b(x, y)) * share;
        brush.a(x, y) += (1.0f - brush.a(x, y)) * share;
      }
  });
}

}  // namespace

void blendEdges(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                BrushResult& brush) {
  if (planes.coverage.empty()) return;
  const Labels own = ownCryptomatteIds(plan, styled);
  blendByCoverage({brush.r, brush.g, brush.b, brush.a}, own, coverageRanks(planes));
}

bool knowsMeanNormals(const FramePlanes& planes) {
  return !planes.meanNormal.x.empty() && !planes.coverage.empty();
}

void blendByNormals(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                    View<const uint8_t> joins, BrushResult& brush) {
  const Labels own = ownCryptomatteIds(plan, styled);
  const std::vector<CoverageRank> ranks = coverageRanks(planes);
  blendByMeanNormals({brush.r, brush.g, brush.b, brush.a},
                     {edgeSurfaces(planes, styled, joins), own, ranks, planes.meanNormal});
}

void blendInside(const FramePlanes& planes, const StyledSurfaces& styled, View<const uint8_t> joins,
                 BrushResult& brush) {
  blendInnerEdges(edgeSurfaces(planes, styled, joins),
                  {brush.r.view(), brush.g.view(), brush.b.view(), brush.a.view()});
}

void putBeautyBehind(const FramePlanes& planes, BrushResult& brush) {
  const ColourViews beauty{planes.beauty.x, planes.beauty.y, planes.beauty.z, planes.alpha};
  layOverPicture({brush.r.view(), brush.g.view(), brush.b.view(), brush.a.view()}, beauty,
                 coverageRanks(planes));
}

void paintStyleEdges(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                     const BrushResult& own, const PaintGround* ground, BrushResult& brush) {
  const std::vector<CoverageRank> ranks = coverageRanks(planes);
  std::vector<uint32_t> ids;
  if (!ranks.empty()) ids = cryptomatteIdsOf(plan, styled);
  EdgePaint paint{{own.r, own.g, own.b, own.a}, styled.anchorIndex, styled.edges};
  if (plan.sidecar || planes.rays) {
    paint.position = planes.position;
    paint.eye = V3f(plan.sidecar ? plan.sidecar->camera.position : planes.rays->eye);
  } else {
    paint.distance = planes.depth;
  }
  paint.grain = brush.grain;
  paint.coverageIds = std::span(ids).subspan(ids.empty() ? 0 : 1);
  paint.coverage = ranks;
  paint.ground = ground;
  paintEdges(paint, {brush.r, brush.g, brush.b, brush.a});
}

Floats drawStyleOutlines(const FramePlan& plan, const FramePlanes& planes,
                         const StyledSurfaces& styled, bool always, BrushResult& brush) {
  const bool any = std::any_of(styled.outlines.begin(), styled.outlines.end(),
                               [](const StyleOutline& line) { return line.colour.has_value(); });
  if (!any && !always) return {};
  // Lines are drawn between anchors, so the owner of a line names its style.
  Labels anchors(planes.width, planes.height);
  std::copy_n(styled.anchorIndex.row(0), anchors.view().pixels(), anchors.row(0));
  const Floats depth = cameraDistance(plan, planes);
  Floats all(planes.width, planes.height, 0.0f);
  std::vector<bool> drawn(styled.outlines.size(), false);
  for (size_t first = 0; first < drawn.size(); ++first) {
    if (drawn[first]) continue;
    const OutlineParams& params = styled.outlines[first].params;
    std::vector<bool> own(drawn.size(), false);
    for (size_t i = first; i < drawn.size(); ++i)
      own[i] = sameParams(outlineParameters, styled.outlines[i].params, params);
    std::transform(drawn.begin(), drawn.end(), own.begin(), drawn.begin(), std::logical_or<>());
    const OutlineResult lines =
        drawOutlines(anchors, planes.normal, planes.position, depth, params);
    paintLines(lines, styled, own, always, brush, all);
  }
  return all;
}

}  // namespace kagefude
