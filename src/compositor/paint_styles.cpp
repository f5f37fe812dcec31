#include "compositor/paint_styles.h"

#include <algorithm>

#include "base/same_params.h"
#include "compositor/stroke_normals.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

/// The number of the first anchor with the same parameters, for each anchor.
std::vector<size_t> groupsOf(const std::vector<BrushParams>& params) {
  std::vector<size_t> groups;
  for (const BrushParams& own : params) {
    const auto first = std::find_if(params.begin(), params.end(), [&](const BrushParams& other) {
      return sameParams(brushParameters, own, other);
    });
    groups.push_back(static_cast<size_t>(first - params.begin()));
  }
  return groups;
}

Plane<uint16_t> onlyGroup(View<const uint16_t> index, const std::vector<size_t>& groups,
                          size_t group) {
  Plane<uint16_t> own(index.width, index.height);
  parallelRows(index.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < index.width; ++x) {
        const uint16_t anchor = index(x, y);
        own(x, y) = anchor != 0 && groups[anchor - 1u] == group ? anchor : uint16_t{0};
      }
  });
  return own;
}

/// What of strokes is wanted beside their colour.
struct Wanted {
  bool diagnostics = false, grain = false;
};

BrushResult lay(const StripSet& strips, const FramePlanes& planes, const StrokeLayer& layer,
                const StyledSurfaces& styled, View<const uint32_t> surfaces, const Wanted& wanted) {
  BrushResult result;
  const Vec3Plane smooth = strokeNormals(planes, styled, surfaces);
  const Vec3View normals = smooth.empty() ? planes.normal.view() : smooth.view();
  const auto paint = [&](View<const uint16_t> index, BrushParams params, bool keepOthers) {
    params.diagnostics = wanted.diagnostics;
    params.keepsGrain = wanted.grain;
    applyBrush(planes.position, normals, layer.tone, index, layer.anchors, strips.strips(), params,
               result, keepOthers, styled.rest);
  };
  const std::vector<size_t> groups = groupsOf(styled.brushes);
  const bool oneGroup = std::all_of(groups.begin(), groups.end(), [](size_t g) { return g == 0; });
  if (oneGroup)
    paint(layer.index, styled.brushes.empty() ? BrushParams{} : styled.brushes[0], false);
  else
    for (size_t i = 0; i < groups.size(); ++i)
      if (groups[i] == i) paint(onlyGroup(layer.index, groups, i), styled.brushes[i], i > 0);
  return result;
}

}  // namespace

BrushResult paintStyles(const StripSet& strips, const FramePlanes& planes, View<const float> tone,
                        const StyledSurfaces& styled, View<const uint32_t> surfaces,
                        bool diagnostics, bool grain) {
  return lay(strips, planes, {styled.anchorIndex, styled.anchors, tone}, styled, surfaces,
             {diagnostics, grain});
}

BrushResult paintLayer(const StripSet& strips, const FramePlanes& planes, const StrokeLayer& layer,
                       const StyledSurfaces& styled, View<const uint32_t> surfaces) {
  return lay(strips, planes, layer, styled, surfaces, {});
}

}  // namespace kagefude
