#pragma once

#include "base/parameter.h"
#include "image/plane.h"

namespace kagefude {

struct SmoothParams {
  int h = 2;  ///< half width of the window, pixels; 0 = no smoothing
  bool allMethods = false;
};

inline constexpr Parameter smoothParameters[] = {
    number<&SmoothParams::h>("h", 0, 256, "pixels",
                             "Half width of the window that is averaged; 0 turns smoothing off."),
    plain<&SmoothParams::allMethods>(
        "all_methods",
        "Also smooths shadow methods that are left crisp or soft as they are without it: line, "
        "disc, places, coverage, volume, planar, blob."),
};
inline constexpr ParameterTable smoothTable{
    "smooth", "Averages visibility over a window, within each surface.",
    "002 section 4.2.2, eq. 4.4-4.7", smoothParameters};

/// g(i,j) = F/r (002 eq. 4.4-4.7): the mean over the (2h+1)² window of the pixels with the centre's
/// label only. The window is cut off at the frame's edge. Label 0 is background: its values pass
/// through and count nowhere. Values must be finite.
///
/// Exact sums to within 2e-6 of the largest magnitude in the window: sums of 1, 2, 4 … rows and
/// columns are put together to the window's size, so nothing is ever subtracted. A tile in which
/// very many labels meet slides a window with one running double sum a label instead. The tiles are
/// fixed, so the bits do not depend on the number of threads.
/// Throws InputError when sizes differ. Cost: grows with the logarithm of h, and with the labels
/// that meet in a tile up to the sliding window's 2h+1 steps a pixel; scratch per tile only.
Floats smoothWithinSurfaces(View<const float> value, View<const uint32_t> labels,
                            const SmoothParams& params);

}  // namespace kagefude
