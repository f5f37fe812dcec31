#pragma once

#include <cstdint>
#include <vector>

#include "image/plane.h"
#include "passes/search/pixel_set.h"

namespace kagefude {

/// Squared distance, and index, of a pixel that has no site in reach or was not asked for.
inline constexpr uint32_t noSite = 0xffffffffu;

/// Where the sites are, and at which pixels the nearest one is wanted. Kinds and wantedKinds may
/// be the same plane, such as the shadow classes.
struct SiteSearch {
  View<const uint8_t> kinds;  ///< a pixel whose kind is siteKind is a site
  uint8_t siteKind = 1;
  View<const uint8_t> wantedKinds;  ///< a pixel whose kind is wantedKind wants its nearest site
  uint8_t wantedKind = 1;
  View<const uint32_t> labels;  ///< sites count within their label only; empty: no bound
};

/// The pixels of one label: count, corners (upper ones exclusive), and corners of the wanted ones.
struct LabelBox {
  uint32_t label = 0;
  uint32_t pixels = 0;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int wantedX0 = 0, wantedY0 = 0, wantedX1 = 0, wantedY1 = 0;
};

/// Boxes of the labels that have a wanted pixel, by rising label; without labels one box, the whole
/// frame. They hold for every search with the same labels and wanted pixels. Label 0 is background:
/// never a site, never wanted. Cost: one read of both planes, on all threads.
std::vector<LabelBox> findLabelBoxes(const SiteSearch& search);
std::vector<LabelBox> findLabelBoxes(View<const uint32_t> labels, const PixelSet& wanted);

/// Boxes for a search without labels whose sites count within `reach` pixels: of the wanted pixels
/// only, with the sites near them, so that a search round thin things need not go over the frame.
/// It leaves pixels that are not wanted undefined, and may find a site that is farther away, or
/// not the nearest of those.
std::vector<LabelBox> boxesWithin(View<const uint8_t> wantedKinds, uint8_t wantedKind, float reach);

/// Whether a label is so small, or so thin in its box, that its pixels go by lists.
bool isScattered(const LabelBox& box);

/// Squared distance in pixels, exact, from each wanted pixel to the nearest site of its label; a
/// wanted pixel that is a site itself gives 0. noSite at other pixels (of boxesWithin undefined),
/// and where the label has no site. `index` (may be empty: not wanted) gets that site's y * width +
/// x; of sites equally near the one with the smaller y, then the smaller x.
///
/// Method: two separable integer phases (Saito & Toriwaki 1994; Meijster et al. 2000; Felzenszwalb
/// & Huttenlocher 2004): signed row distance down each column, then along rows an outward search in
/// blocks of 32 pixels, with the exact parabola envelope for rows in which a site is farther than
/// 252 pixels. Per label on its box; labels that are tiny or scattered thinly over a large box go
/// by their sorted site lists instead, so thousands of overlapping boxes stay cheap.
///
/// Exact and the same bits on every machine and for any number of threads. Frames up to 32767
/// pixels a side; larger ones, and planes that differ in size, throw InputError.
/// Cost: linear in the frame and in the boxes (at most 32 times their labels' pixels). Scratch: 2
/// bytes a pixel of the largest box.
void findNearestSites(const SiteSearch& search, const std::vector<LabelBox>& boxes,
                      View<uint32_t> squared, View<uint32_t> index = {});

}  // namespace kagefude
