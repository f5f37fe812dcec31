#pragma once

#include "base/parameter.h"
#include "image/plane.h"

namespace kagefude {

enum class PairSearch { exact, grid };
enum class SearchBound { none, object, surface };

struct PairParams {
  PairSearch search = PairSearch::exact;
  int step = 3;           ///< N: every step-th pixel in x and y is searched, pixels
  bool adaptive = false;  ///< smaller steps where the penumbra is narrow
  SearchBound bound = SearchBound::object;
  bool horizon = true;  ///< where a receiver's own horizon parts the masks, go by it (horizon.h)
};

inline constexpr std::string_view pairSearchNames[] = {"exact", "grid"};
inline constexpr std::string_view searchBoundNames[] = {"none", "object", "surface"};
inline constexpr Parameter pairParameters[] = {
    choice<&PairParams::search>(
        "search", pairSearchNames,
        "Search the nearest umbra and lit pixel at every penumbra pixel, or at the points of a "
        "grid with bilinear interpolation between them."),
    number<&PairParams::step>("step", 1, 64, "rendered pixels",
                              "Spacing N of the search grid in x and y, for search = grid."),
    plain<&PairParams::adaptive>(
        "adaptive", "Refine the search grid where the penumbra is narrower than four steps."),
    choice<&PairParams::bound>(
        "bound", searchBoundNames,
        "What a search must not leave: nothing, the object, or the smoothly connected surface."),
    plain<&PairParams::horizon>(
        "horizon",
        "Where one mask stands below the surface's own horizon, take the share of the "
        "light above it instead of a search; off: as the seed."),
};
inline constexpr ParameterTable pairTable{
    "pair", "Visibility between two hard masks from a nearest-pixel search.",
    "000 eq. 3.3-3.7, with 3.4 and 3.6 mended", pairParameters};

/// Visibility from a pair of hard masks (000 chapter 3): 0 in the umbra (hidden in both), 1 where
/// both see the light, and v = D1/(D1 + D2) in the penumbra, with D1 and D2 the distances in pixels
/// to the nearest umbra and lit pixel (eq. 3.3) of the same label.
///
/// farMask, nearMask: 0 = the light is hidden from this place, else seen; nothing depends on which
/// is which. labels: 0 = background, never a site, visibility 1. Object ids or surface labels, as
/// `bound` asks; the caller picks the plane. With bound = none only background is told apart.
///
/// Departures: eq. 3.4 prints the density D2/(D1 + D2) but calls its 0 black; here it is mended to
/// visibility. Eq. 3.6 has its weights swapped; 3.7 is used, in the equal form of two lerps.
/// search = grid: values at pixels whose x and y are multiples of `step`, and in the last column
/// and row; a pixel interpolates the four corners of its cell. Corners of another label do not
/// count, the weights of the rest are scaled up, and with none left the pixel is searched itself.
/// adaptive: a cell of `step` pixels is cut so that the narrowest penumbra at its corners (D1 + D2)
/// spans four pieces or more; cells whose penumbra touches no corner are searched at every pixel.
///
/// Degenerate: a label with penumbra but no umbra gives v = M/(M + D2), M the largest D2 of the
/// label: 1 at the lit edge, falling to 1/2 where the shadow is deepest, since one of two masks
/// still sees the light. Without lit pixels likewise v = D1/(D1 + M), from 0 up to 1/2; with
/// neither 1/2. Throws InputError when sizes differ.
/// Cost: two nearest-site searches (see nearest_site.h); 12 bytes a pixel of scratch.
Floats pairVisibility(View<const uint8_t> farMask, View<const uint8_t> nearMask,
                      View<const uint32_t> labels, const PairParams& params);

}  // namespace kagefude
