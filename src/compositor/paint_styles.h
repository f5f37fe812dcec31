#pragma once

#include "compositor/frame_planes.h"
#include "compositor/strip_set.h"
#include "compositor/styled_surfaces.h"
#include "passes/brush/brush_map.h"

namespace kagefude {

/// Lays the strokes of every style (see applyBrush): styles whose brush parameters are equal in one
/// go, the others one after the other. `surfaces` bound the smoothing of normals (strokeNormals).
/// `diagnostics` asks for the angle and repeat planes, `grain` for that of the strokes.
BrushResult paintStyles(const StripSet& strips, const FramePlanes& planes, View<const float> tone,
                        const StyledSurfaces& styled, View<const uint32_t> surfaces,
                        bool diagnostics, bool grain);

/// Strokes by other anchors and tones than those of the styles, whose brushes they keep.
struct StrokeLayer {
  View<const uint16_t> index;  ///< as StyledSurfaces::anchorIndex
  const std::vector<BrushAnchor>& anchors;
  View<const float> tone;
};
BrushResult paintLayer(const StripSet& strips, const FramePlanes& planes, const StrokeLayer& layer,
                       const StyledSurfaces& styled, View<const uint32_t> surfaces);

}  // namespace kagefude
