#pragma once

#include <cstdint>
#include <span>

#include "passes/brush/brush_anchor.h"
#include "passes/strip/strip.h"

namespace kagefude {

/// Scene-linear colour with associated alpha; angle and repeat are empty unless asked for.
struct BrushResult {
  Floats r, g, b, a;
  Floats angle;   ///< W of the weightiest reference point, turns, [0, 1)
  Floats repeat;  ///< Pd / Md of the same, its whole part is T
  Floats grain;   ///< of the strokes, see BrushParams::keepsGrain
};

/// A copy of colours and grain.
BrushResult cloneColours(const BrushResult& strokes);

/// Brush touch (002 §3.5): colours every pixel of anchor index i > 0 from the strip of
/// anchors[i - 1], row v = tone, and a place u along the row.
/// - `seed`: C1 = strip(W T, c), C2 = strip(W (T + 1), c), M = C1 (1 - t) + C2 t (eq. 3.10, 3.11,
///   mended: the seed's text swaps u and v), bilinear, T = 0 reads the left edge only.
/// - `polar` **[ours]**: the same rings, but the cross-fade keeps the strip's contrast, lookups are
///   filtered, the ring round the axis has one repeat that fades in over `pole_fade` rings.
/// - `held`, grain `tone` **[ours]**: u runs along the object's own axes, u_k = P_k / (2π Md), so
/// that
///   strokes stay on the object along their row. Of the three axes those count that run along the
///   tone's circles round the light axis (projected onto the surface when normals are given), by
///   w_k = max(0, m_k / max m - 3/5)², m_k the squared parts of that direction. There is no angle
///   to wrap, no ring and no pole: on the axis itself all weigh alike. Across the row v = tone
///   still slides when the tone changes, and a flat tone shows one row as straight bands.
/// - `held`, grain `object` **[ours]**: the strip taken apart (StripGrain). The grain lies in the
/// plane
///   of two of the object's axes that the surface faces (weights as above, of the squared parts of
///   the normal; without normals of the positions' own), along the axis that the strokes run along
///   and across the other; the colours are those of the tone at that grain. Nothing but colour
///   follows the tone, so a change of light shows as the tone itself does.
/// Mixing, where several patterns meet (rings, axes, reference points, octaves):
/// (of object grain the grains are mixed so, about their mean 0, before they pick a colour)
/// M = mean + contrast Σ w (C - mean) / √Σ w² with the row's mean colour, or / Σ w (linear).
/// Negative results become 0, but for `seed`. Filtering: footprints from the neighbours of the same
/// anchor, of the two the one that differs less, of the tone only where both rise or both fall, so
/// that silhouettes, hard shadow edges and things a pixel or two wide stay sharp; angles by their
/// analytic derivative, so the wrap does not show. Index 0, indices beyond the list, and non-finite
/// positions give 0; a NaN tone is 0. All planes must be of one size; `normal` may be empty; every
/// strip index must be valid (InputError). Memory: 16 bytes a pixel for the result, 24 with
/// diagnostics. The same bits for any threads.
BrushResult applyBrush(Vec3View position, Vec3View normal, View<const float> tone,
                       View<const uint16_t> anchorIndex, std::span<const BrushAnchor> anchors,
                       std::span<const Strip> strips, const BrushParams& params);

/// The same into planes that are there already; they are made anew where they are empty or of
/// another size (fresh memory costs about as much as painting it). With `keepOthers` pixels of no
/// anchor stay as they are, so that several calls fill one picture.
/// **[ours]** `rest` holds strokes to surfaces that deform: where each pixel's surface point lies
/// along the object's axes while nothing deforms it, in world units from the object's origin;
/// finite at every pixel of an anchor that is `atRest`. Places, their footprints and the reference
/// points' shares are then taken from it. Which axes held strokes run along, and which plane the
/// surface faces, is decided there too, by the light and the surface as it is seen: with the
/// object's axes as the columns of O, a reference point G on the light's axis V, the place q, and
/// the seen unit normal N,
///   v = Oᵀ V, g = Oᵀ (G - origin), n = A N / |A N|, r = v × (q - g), t = r - n (n · r),
/// t's squared parts choose the axes, n's the plane. A is the local map of the pixel's neighbours
/// (restAxes), which carries the changes of position to those of the place and the normal of the
/// one to that of the other. V turns with the object's matrix and not with A: A differs from
/// triangle to triangle and from frame to frame, and an axis carried by it flickers. With instances
/// q - g is what lies beyond whole steps of the anchor. Over places that are turned (placesTurned)
/// t is A times the direction that is seen, and it is painted a pixel at a time. With `stretch =
/// world` held strokes change their octave by the stretch of that map (strokeOctave). A thing that
/// does not deform looks as it does without, within roundings of its positions' changes.
void applyBrush(Vec3View position, Vec3View normal, View<const float> tone,
                View<const uint16_t> anchorIndex, std::span<const BrushAnchor> anchors,
                std::span<const Strip> strips, const BrushParams& params, BrushResult& result,
                bool keepOthers = false, Vec3View rest = {});

}  // namespace kagefude
