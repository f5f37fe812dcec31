#pragma once

#include <string_view>

#include "base/parameter.h"

namespace kagefude {

/// [edges]: how a style's paint ends.
struct PaintedEdgeParams {
  enum class Size { screen, object };
  float rough = 0;
  float overrun = 0;
  float dry = 0;
  float dryWidth = 24;
  float rim = 0;
  float rimStrength = 0.5f;
  float lost = 0;
  float lostTone = 0.15f;
  Size size = Size::screen;

  /// Whether any of it changes a picture.
  bool acts() const {
    return rough > 0 || dry > 0 || (rim > 0 && rimStrength > 0) || (lost > 0 && lostTone > 0);
  }
};

inline constexpr std::string_view edgeSizes[] = {"screen", "object"};
inline constexpr Parameter paintedEdgeParameters[] = {
    number<&PaintedEdgeParams::rough>("rough", 0, 256, "pixels",
                                      "How far strokes break and overrun the edges of what they "
                                      "paint, by their own grain; 0 ends them at the edge."),
    number<&PaintedEdgeParams::overrun>("overrun", -1, 1, "",
                                        "Which way rough edges go: -1 breaks inward alone, 1 "
                                        "overruns alone."),
    number<&PaintedEdgeParams::dry>("dry", 0, 1, "",
                                    "How much of the paint a dry brush leaves out towards edges, "
                                    "in the hollows of its strokes; the ground shows there."),
    number<&PaintedEdgeParams::dryWidth>("dry_width", 1, 4096, "pixels",
                                         "How far from the edge the brush runs dry."),
    number<&PaintedEdgeParams::rim>("rim", 0, 256, "pixels",
                                    "Width of the dark rim that a wash leaves where it dries at "
                                    "its edge; 0: none."),
    number<&PaintedEdgeParams::rimStrength>("rim_strength", 0, 4, "",
                                            "How much more pigment lies in the rim than in the "
                                            "wash."),
    number<&PaintedEdgeParams::lost>("lost", 0, 256, "pixels",
                                     "Width over which an edge melts where both sides are equally "
                                     "bright; 0 keeps every edge."),
    number<&PaintedEdgeParams::lostTone>("lost_tone", 0, 1, "",
                                         "Difference of brightness, as the eye sees it, from which "
                                         "an edge is kept."),
    choice<&PaintedEdgeParams::size>("size", edgeSizes,
                                     "Whether these widths are pixels, or keep to the object: then "
                                     "they are those at which the strip's width covers "
                                     "brush.strip_pixels."),
};
inline constexpr ParameterTable paintedEdgeTable{
    "edges", "How a style's paint ends: broken, dry, pooled or lost edges.", "ours",
    paintedEdgeParameters};

}  // namespace kagefude
