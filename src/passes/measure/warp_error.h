#pragma once

#include <cstdint>
#include <span>

#include "image/vec.h"

namespace kagefude {

/// Where the surface of each pixel was in the previous picture.
struct PreviousPlaces {
  Floats x, y;         ///< column and row, between pixel centres; NaN where it is not compared
  Bytes smooth;        ///< 1 where the 4 x 4 pixels round the place show the same surface
  int64_t pixels = 0;  ///< that are compared
};

/// What findPreviousPlaces goes by. motionX, motionY are Blender's Vector X and Y: pixels from here
/// to the place in the previous frame, y upward, so the place is (x + motionX, y - motionY).
/// `expected`: where each pixel's surface point was in the world at the previous frame; with
/// `previousPosition` it finds what one part of an object hides of another. Both may be empty.
struct MotionInput {
  View<const uint32_t> ids, previousIds;  ///< 0 = background
  View<const float> motionX, motionY;
  Vec3View position, expected, previousPosition;
};

/// **[ours]** Follows the motion back by one frame. Left out: background; pixels with another
/// object among their eight neighbours, for edges are blends; places off the previous picture;
/// non-finite motion; and occlusions: places where any of the four pixels read has another id, or
/// whose position is farther from the expected one than 1.5 times the step to the next pixel. All
/// planes are of one size. The same for any threads.
PreviousPlaces findPreviousPlaces(const MotionInput& in);

/// How much a picture changed beyond the motion of what it shows.
struct WarpError {
  double rmse = 0;     ///< root of the mean squared difference over pixels and channels
  int64_t pixels = 0;  ///< compared; 0 when nothing of the frame was visible in the previous one
  Floats perPixel;     ///< root mean square over the channels; -1 where nothing is compared
};

/// **[ours]** Warp error between neighbouring frames: every pixel of this frame against the
/// previous frame at the place its surface came from, read by Catmull-Rom over 4 x 4 pixels where
/// `smooth` says so (bilinear reading alone would count its own blur as an error of fine strokes),
/// else bilinearly. Non-finite colours are left out. Planes of one channel lie at the same place in
/// `current` and `previous`; all are of one size. Rows are summed in order, so the same bits for
/// any threads.
WarpError warpError(std::span<const View<const float>> current,
                    std::span<const View<const float>> previous, const PreviousPlaces& places);

}  // namespace kagefude
