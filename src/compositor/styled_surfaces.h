#pragma once

#include <optional>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/strip_set.h"
#include "passes/brush/brush_anchor.h"
#include "passes/edges/outline.h"
#include "passes/edges/painted_edge_params.h"
#include "passes/tone/tint.h"
#include "passes/tone/tone.h"
#include "passes/tone/tone_floor.h"

namespace kagefude {

/// The outlines of one style; none without a colour.
struct StyleOutline {
  std::optional<V3f> colour;
  OutlineParams params;
};

/// A light that strips of its own paint (light.strip, style.light_strips).
struct OwnLight {
  size_t light = 0;                  ///< place in the plan's lights
  std::vector<bool> paints;          ///< per anchor; false: it counts in the style's own strip
  std::vector<BrushAnchor> anchors;  ///< per anchor: its strip, whose strokes run round the light
  std::vector<bool> multiplies;      ///< per anchor: the strip multiplies the surface's colour
};

/// Which strokes every pixel gets: one anchor for each pair of object and style that is seen.
struct StyledSurfaces {
  std::vector<bool> fitting;    ///< each style of the look: whether it fits a surface that is seen
  std::vector<bool> outranked;  ///< and whether one of higher priority paints such a surface
  Plane<uint16_t> anchorIndex;  ///< 0 = background, i -> anchors[i - 1]
  std::vector<uint32_t> objects;  ///< by anchorIndex: whose surface it is; the background's is 0
  std::vector<BrushAnchor> anchors;
  Vec3Plane rest;           ///< places at rest of the anchors that lie there; empty where none does
  std::vector<int> styles;  ///< per anchor: place in the look's list, -1: none matches
  std::vector<BrushParams> brushes;      ///< per anchor
  std::vector<ToneParams> tones;         ///< per anchor
  std::vector<bool> multiplies;          ///< per anchor: the strip multiplies the surface's colour
  std::vector<StyleOutline> outlines;    ///< per anchor
  std::vector<PaintedEdgeParams> edges;  ///< per anchor, widths in pixels
  std::vector<TintParams> tints;         ///< per anchor
  std::vector<OwnLight> ownLights;       ///< those that paint any anchor
  std::vector<float> stripPixels;  ///< per anchor: pixels that the strip's width covers; 0: unknown
};

/// A tone of the lights becomes that which picks rows: raised (raiseTone), then levelled
/// (adjustTone). In place.
void levelTone(const ToneFloor& floor, const StyledSurfaces& styled, View<float> tone);

/// Whether any style's paint ends by [edges].
bool paintsEdges(const StyledSurfaces& styled);

/// Gives every object (and material, where styles ask) the style that matches (chooseStyle), or the
/// look's own brush with the built-in strip, and lays its anchor by the sidecar's bounds and
/// reference point. Objects that no sidecar describes are anchored at the middle of their visible
/// pixels' bounds; `plan.warnings` is the caller's to extend with the returned `warnings`. Anchors
/// are numbered by their first pixel in reading order. Throws InputError beyond 65,535 anchors,
/// LookError when a style names a light that does not take part.
StyledSurfaces styleSurfaces(const Look& look, const StripSet& strips, const FramePlan& plan,
                             const FramePlanes& planes, std::vector<std::string>& warnings);

}  // namespace kagefude
