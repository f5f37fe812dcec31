#pragma once

#include <span>

#include "image/plane.h"
#include "passes/search/pixel_set.h"

namespace kagefude {

/// Signed distances are kept in sixteenths of a pixel.
inline constexpr float distanceUnit = 1.0f / 16.0f;
inline constexpr int16_t farLit = 32767, farDark = -32767;  ///< no pixel of the other kind in reach

/// One row a mask, one column a wanted pixel, numbered as the PixelSet numbers them.
using Distances = Plane<int16_t>;

/// For each mask the signed distance of the wanted pixels to the mask's edge within their label, in
/// sixteenths of a pixel: positive in lit pixels, negative in dark ones, to half a pixel before the
/// nearest pixel of the other kind (exact squared distances, see nearest_site.h). Distances over
/// 2000 pixels, and labels without a pixel of the other kind, give farLit or farDark.
///
/// masks: 0 = hidden. labels: 0 = background, which has no wanted pixel; empty: no bound.
/// Throws InputError when sizes differ. Cost: for every mask one read of the labels' boxes and a
/// row search at the wanted pixels. Scratch: 4 bytes a pixel of the largest box, for every thread
/// where boxes are below a million pixels; so that threads need not share one.
Distances maskDistances(std::span<const View<const uint8_t>> masks, const PixelSet& wanted,
                        View<const uint32_t> labels);

}  // namespace kagefude
