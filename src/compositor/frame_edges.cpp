#include "compositor/frame_edges.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "base/same_params.h"
#include "image/parallel.h"
#include "passes/edges/behind_paint.h"
#include "passes/edges/inner_edges.h"
#include "passes/edges/mean_normals.h"
#include "passes/edges/outline.h"
#include "passes/edges/painted_edges.h"

namespace kagefude {
namespace {

/// Each pixel's own thing in the Cryptomatte's ids.
Labels ownCryptomatteIds(const FramePlan& plan, View<const uint32_t> objects) {
  Labels ids(objects.width, objects.height);
  parallelRows(objects.height, [&](int first, int end) {
    std::unordered_map<uint32_t, uint32_t> known{{0u, 0u}};
    uint32_t last = 0, lastId = 0;
    uint32_t* id = ids.row(first);
    for (const uint32_t* object = objects.row(first); object != objects.row(end); ++object, ++id) {
      if (*object != last) {
        const auto [found, isNew] = known.try_emplace(*object, 0);
        if (isNew) found->second = plan.cryptomatteIdOf(*object);
        last = *object;
        lastId = found->second;
      }
      *id = lastId;
    }
  });
  return ids;
}

/// The Cryptomatte's id of each anchor's thing.
std::vector<uint32_t> cryptomatteIdsOf(const FramePlan& plan, View<const uint32_t> objects,
                                       const StyledSurfaces& styled) {
  std::vector<uint32_t> ids(styled.anchors.size(), 0u);
  uint16_t known = 0;  // anchors are numbered by their first pixel
  const uint16_t* const anchors = styled.anchorIndex.row(0);
  for (size_t i = 0; i < objects.pixels() && known < ids.size(); ++i)
    if (anchors[i] == known + 1) ids[known++] = plan.cryptomatteIdOf(objects.data[i]);
  return ids;
}

std::vector<CoverageRank> coverageRanks(const FramePlanes& planes) {
  std::vector<CoverageRank> ranks;
  for (size_t i = 0; i < planes.coverageIds.size(); ++i)
    ranks.push_back({planes.coverageIds[i], planes.coverageShares[i]});
  return ranks;
}

EdgeSurfaces edgeSurfaces(const FramePlanes& planes, const StyledSurfaces& styled,
                          View<const uint8_t> joins) {
  EdgeSurfaces surfaces{planes.objectId, styled.anchorIndex, joins, planes.normal, planes.position};
  surfaces.rays = planes.rays ? &*planes.rays : nullptr;
  surfaces.betweenObjects = planes.coverageIds.empty();
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

void blendEdges(const FramePlan& plan, const FramePlanes& planes, BrushResult& brush) {
  if (planes.coverageIds.empty()) return;
  const Labels own = ownCryptomatteIds(plan, planes.objectId);
  blendByCoverage({brush.r, brush.g, brush.b, brush.a}, own, coverageRanks(planes));
}

bool knowsMeanNormals(const FramePlanes& planes) {
  return !planes.meanNormal.x.empty() && !planes.coverageIds.empty();
}

void blendByNormals(const FramePlan& plan, const FramePlanes& planes, const StyledSurfaces& styled,
                    View<const uint8_t> joins, BrushResult& brush) {
  const Labels own = ownCryptomatteIds(plan, planes.objectId);
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
  if (!ranks.empty()) ids = cryptomatteIdsOf(plan, planes.objectId, styled);
  EdgePaint paint{{own.r, own.g, own.b, own.a}, styled.anchorIndex, styled.edges};
  if (plan.sidecar || planes.rays) {
    paint.position = planes.position;
    paint.eye = V3f(plan.sidecar ? plan.sidecar->camera.position : planes.rays->eye);
  } else {
    paint.distance = planes.depth;
  }
  paint.grain = brush.grain;
  paint.coverageIds = ids;
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
