#pragma once

#include <cstdint>
#include <span>

#include "image/plane.h"

namespace kagefude {

/// How much a picture changed beyond the motion of what it shows.
struct WarpError {
  double rmse = 0;     ///< root of the mean squared difference over pixels and channels
  int64_t pixels = 0;  ///< compared; 0 when nothing of the frame was visible in the previous one
  Floats perPixel;     ///< root mean square over the channels; -1 where nothing is compared
};

/// **[ours]** Warp error between neighbouring frames: every pixel of this frame is compared with
/// the previous frame at the place its surface came from, read bilinearly. motionX, motionY are
/// Blender's Vector X and Y: pixels from here to the place in the previous frame, y upward, so the
/// place is (x + motionX, y - motionY). Left out: background (id 0), places off the previous
/// picture, non-finite motion or colours, and occlusions: places where any of the four pixels read
/// has another id. Planes of one channel lie at the same place in `current` and `previous`; all
/// are of one size. Rows are summed in order, so the same bits for any threads.
WarpError warpError(std::span<const View<const float>> current,
                    std::span<const View<const float>> previous, View<const uint32_t> currentIds,
                    View<const uint32_t> previousIds, View<const float> motionX,
                    View<const float> motionY);

}  // namespace kagefude
