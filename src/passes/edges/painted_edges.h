#pragma once

#include <cstdint>
#include <span>

#include "image/vec.h"
#include "passes/edges/behind_paint.h"
#include "passes/edges/painted_edge_params.h"

namespace kagefude {

/// What is known of a picture whose paint gets its edges.
struct EdgePaint {
  ColourViews own;                            ///< each pixel's paint, of the thing at its centre
  View<const uint16_t> things;                ///< 0 = background, i -> params[i - 1]
  std::span<const PaintedEdgeParams> params;  ///< widths in pixels
  Vec3View position{};           ///< world; with `eye` it tells what is in front; may be empty
  V3f eye{0, 0, 0};              ///< of the camera
  View<const float> distance{};  ///< from the camera, only compared, where no position is given
  View<const float> grain{};     ///< of the strokes, mean 0 and variance 1
  std::span<const uint32_t> coverageIds{};   ///< each thing as the ranks name it
  std::span<const CoverageRank> coverage{};  ///< empty: edges run between pixels
  const PaintGround* ground = nullptr;       ///< behind things; null: nothing is known of it
};

/// **[ours]** Ends paint as a brush does. paint: associated, its things met by coverage; in place.
///
/// Near a border between two things (or a thing and the background) every pixel has a signed
/// distance to it, positive in the thing in front (the nearer to the camera, the smaller where one
/// stands on the other; background is behind everything), to the straight piece of border of the
/// nearest pixel of its own at it, which is placed and turned within the pixel (BorderSites). The
/// grain of the strokes in front moves the border: distance + rough (g + overrun), g = 1.1 times
/// the mean grain round the border, over half of `rough` but at least 2 pixels to all sides, evened
/// and sloped along the border, and up to 0.2 times the pixel's, within ±1. A thing is moved by no
/// more than half of half its thickness, and what is hardly wider than a pixel not at all: it would
/// fall to crumbs. The step across the new border is a pixel wide, more by 0.15 of `rough` and
/// where the border runs slantwise to the old one. Each side's paint goes on beyond the border as
/// its mirror image. So strokes break and overrun by their own shape, and stay with the object as
/// its strokes do. What a thing in front of the background leaves is empty.
/// - lost: where both sides' means round the border are equally bright (roots of luminance), fading
///   out at `lost_tone`, the step from one side to the other takes half of `lost` more, and the
///   pixel's grain moves it by a quarter to both ways: strokes reach into each other. No more than
///   the thinner side is thick.
/// - rim: pigment is d = 1 + rim_strength f times as dense, colour c^d, f rising from the border to
///   a quarter of `rim` and falling from there to its end; as a whole no darker than 1/d of the
///   wash, so that on dark things it is a deeper tone of theirs and not black.
/// - dry: paint is left out where the grain is lower than a bound that rises towards the border,
///   along stretches of it where the strokes' mean grain is low; elsewhere the brush is full. Gaps
///   take the thing's own share of a pixel alone.
/// Pixels that no effect reaches keep their bits. Of a border the params of the thing in front
/// hold; rim and dry gaps lie on its side. Depends on this frame alone; the same bits for any
/// threads. Throws InputError when sizes differ. Cost: a nearest-site search, some hundred
/// operations a pixel near borders.
void paintEdges(const EdgePaint& in, const PaintViews& paint);

}  // namespace kagefude
