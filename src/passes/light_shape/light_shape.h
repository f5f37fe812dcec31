#pragma once

#include <optional>
#include <span>

#include "base/parameter.h"
#include "image/plane.h"
#include "image/vec.h"
#include "passes/search/pair_search.h"

namespace kagefude {

enum class DiscIntegral { wedges, linear };

struct LightShapeParams {
  float lightSize = 1.0f;  ///< share of the rendered light's radius
  DiscIntegral disc = DiscIntegral::wedges;
  bool follow = true;    ///< follow shadows that are thinner than their shift between masks
  bool depthMap = true;  ///< held against the light's depth map
  SearchBound bound = SearchBound::object;
  float grow = 0.0f;    ///< pixels by which shadows grow; negative: shrink
  float soften = 0.0f;  ///< further light radius, as a share of the rendered one
  int abstract = 0;     ///< half width of the window that simplifies contours, pixels
};

inline constexpr std::string_view discIntegralNames[] = {"wedges", "linear"};
inline constexpr Parameter lightShapeParameters[] = {
    number<&LightShapeParams::lightSize>(
        "light_size", 0, 1, "of the rendered light",
        "Radius of the light; 0 gives the hard shadow of the light's centre."),
    choice<&LightShapeParams::disc>(
        "disc", discIntegralNames,
        "How a disc of masks is integrated: piecewise over wedges, or by one linear fit."),
    plain<&LightShapeParams::follow>(
        "follow", "Follow shadows thinner than their shift from mask to mask (wedges only)."),
    plain<&LightShapeParams::depthMap>(
        "depth_map",
        "Round lights with a depth map: take the map's visibility where the masks bear it out."),
    choice<&LightShapeParams::bound>(
        "bound", searchBoundNames,
        "What distances must not leave: nothing, the object, or the smoothly connected surface."),
    number<&LightShapeParams::grow>("grow", -256, 256, "pixels",
                                    "Grows the shadows; negative shrinks them."),
    number<&LightShapeParams::soften>("soften", 0, 4, "of the rendered light",
                                      "Radius added to the light beyond what was rendered."),
    number<&LightShapeParams::abstract>("abstract", 0, 64, "pixels",
                                        "Half width of the window that simplifies contours."),
};
inline constexpr ParameterTable lightShapeTable{
    "light_shape", "Visibility of a light from hard masks of several of its points.",
    "method.md section 4; Heidrich, Brabec & Seidel 2000 for lines; DeCoro et al. 2007 for style",
    lightShapeParameters};

/// How a place on the light moves in the world, so that shadows can be followed between masks.
struct LightGeometry {
  bool sun = false;
  V3f position{0, 0, 0};       ///< world; not for a sun
  V3f direction{0, 0, -1};     ///< unit, the way the light travels; for a sun only
  V3f u{0, 0, 0}, v{0, 0, 0};  ///< world vectors of one unit of place; a sun's change the way to it
  bool sphere = false;         ///< the light is round from every side: its disc faces each receiver
};

/// What masks lie on: all with v = 0 are a line; with masks at (±1, ±1) a rectangle; else a disc.
/// The first mask of a disc or a rectangle is its centre.
struct LightShapeResult {
  Floats visibility;
  /// 1 where distances are measured, falling to 0 where they are extrapolated; empty: not asked for
  Floats confidence;
  Bytes unsure;  ///< 1 where masks disagree or a shadow was followed; empty also with a style
};

/// What beside the visibility is asked for.
struct LightShapeWanted {
  bool confidence = true, unsure = true;
};

/// Visibility of a disc, rectangle or line light from K hard masks of known places: the share of
/// the light from which the pixel is seen.
///
/// masks: 0 = hidden from that place, else seen. places: of the masks, in radii; a disc has its
/// centre first, then a ring in turning order, which may be followed by masks anywhere in it
/// (disc_places.h); a rectangle its centre, then its four corners and any others of it, in half
/// sides; a line has v = 0 and rising u. labels:
/// 0 = background, visibility 1, confidence 1; object ids or surface labels, as `bound` asks.
/// position, normal: world; used with `follow` only, and may then be empty, like `geometry`:
/// shadows are then not followed.
///
/// For each mask the signed distance s to its shadow's edge within the label, in pixels, positive
/// when lit, half a pixel short of the nearest pixel of the other kind. Where the light moves a
/// little the edge moves a little, so s is interpolated over the light and the result is the share
/// where it is positive: exact over each wedge of a disc (method.md section 4) or each triangle
/// between its masks (light_mesh.h; a rectangle's always), over each piece of a line, or by the
/// closed form for one plane through all masks (disc = linear). follow: a shadow thinner than its
/// shift between neighbouring masks is missed by that. There the shift is found by matching the
/// masks (see shadow_follow.h) and the masks are moved along it.
///
/// lightSize is continuous; 0 equals the hard mask of the centre (a line's: its middle).
/// Degenerate: a mask without a pixel of the other kind in the label stands in with the largest
/// distance that other masks have at the pixel, 1 if none has: a label of one pixel gives a share
/// of its masks. confidence: the share of masks with a site, less where the frame's edge is nearer
/// than the site. With style knobs (grow, soften, abstract) nothing is followed.
/// Throws InputError when planes differ in size or masks are fewer than 2 (line) or 5 (disc).
/// Cost: a search of both kinds of sites a mask; scratch of 2 bytes a mask for every pixel where
/// masks disagree (with a style: every pixel), and with `follow` 4 bytes a pixel, or 12 with more
/// than 16 masks.
LightShapeResult lightShapeVisibility(std::span<const View<const uint8_t>> masks,
                                      std::span<const V2f> places, View<const uint32_t> labels,
                                      Vec3View position, Vec3View normal,
                                      const std::optional<LightGeometry>& geometry,
                                      const LightShapeParams& params,
                                      const LightShapeWanted& wanted = {});

}  // namespace kagefude
