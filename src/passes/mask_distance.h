#pragma once

#include <span>
#include <vector>

#include "image/plane.h"

namespace kagefude {

/// Signed distances are kept in sixteenths of a pixel.
using Distances = Plane<int16_t>;
inline constexpr float distanceUnit = 1.0f / 16.0f;
inline constexpr int16_t farLit = 32767, farDark = -32767;  ///< no pixel of the other kind in reach

/// For each mask the signed distance of the wanted pixels to the mask's edge within their label, in
/// sixteenths of a pixel: positive in lit pixels, negative in dark ones, to half a pixel before the
/// nearest pixel of the other kind (exact squared distances, see nearest_site.h). Distances over
/// 2000 pixels, and labels without a pixel of the other kind, give farLit or farDark. Other pixels
/// are 0.
///
/// masks: 0 = hidden. wanted: 1 = wanted. labels: 0 = background; empty: no bound.
/// Throws InputError when sizes differ. Cost: two nearest-site searches a mask.
std::vector<Distances> maskDistances(std::span<const View<const uint8_t>> masks,
                                     View<const uint8_t> wanted, View<const uint32_t> labels);

}  // namespace kagefude
