#pragma once

#include <cstddef>

#include "image/plane.h"

namespace kagefude {

/// How one plane differs from another, the truth.
struct PlaneDifference {
  size_t pixels = 0;          ///< compared
  size_t penumbraPixels = 0;  ///< of them, those with truth in (0.02, 0.98)
  double rmse = 0;
  double penumbraRmse = 0;              ///< 0 without penumbra
  double penumbraBias = 0;              ///< mean of value - truth in the penumbra
  double maximum = 0;                   ///< largest absolute difference
  double median = 0, p90 = 0, p99 = 0;  ///< of the absolute differences in the penumbra
  double truthNoise = 0;                ///< see truthSamples
};

/// Compares value with truth where `where` is not 0 (empty: everywhere). Pixels with NaN or Inf in
/// either plane are left out. truthSamples: samples a pixel that truth was traced with; then
/// truthNoise is the root mean square of √(t (1 - t)/n) over the penumbra, the error that truth
/// itself has when its samples are independent (an upper bound for stratified ones); 0: not known.
/// Sums run in raster order in doubles: the same result for any number of threads.
/// Throws InputError when sizes differ.
PlaneDifference comparePlanes(View<const float> value, View<const float> truth,
                              View<const float> where, int truthSamples);

/// Difference picture: 0.5 + gain (value - truth), clamped to 0..1; 0.5 where `where` is 0.
Floats differencePicture(View<const float> value, View<const float> truth, View<const float> where,
                         float gain);

}  // namespace kagefude
