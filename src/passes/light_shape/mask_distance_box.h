#pragma once

#include <vector>

#include "passes/search/distance_row.h"
#include "passes/search/nearest_site.h"
#include "passes/search/pixel_set.h"

namespace kagefude::detail {

/// sqrt(squared) less half a pixel, in sixteenths of a pixel, negative in dark pixels; out of reach
/// farLit or farDark.
int16_t signedDistance(uint32_t squared, bool lit);

/// Where one mask's distances within one label go: by number of the wanted pixel.
struct MaskBox {
  View<const uint8_t> mask;
  View<const uint32_t> labels;  ///< empty: no bound
  const PixelSet& wanted;
  const LabelBox& box;
  int16_t* distances;
};

/// Scratch of one label at a time, kept from one to the next.
struct BoxScratch {
  std::vector<int16_t> toDark, toLit;  ///< rows to the nearest pixel of a kind in the column
};

/// Signed distances of a label's wanted pixels by two separable phases over its box, both kinds of
/// sites at once. `parallel`: on all threads; else the calling thread only.
void measureBox(const MaskBox& task, BoxScratch& scratch, bool parallel);

}  // namespace kagefude::detail
