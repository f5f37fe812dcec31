#pragma once

#include <vector>

#include "image/vec.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {

/// The colours of a strip along its tones, from its stops, bands and hue shift; all colours are
/// display-encoded sRGB.
class StripGradient {
 public:
  /// Throws LookError unless there are at least two stops whose places rise from 0 to 1. `params`
  /// must outlive it.
  explicit StripGradient(const StripPaintParams& params);

  /// The colour at a place, 0 dark to 1 bright, clamped; of bands the band's.
  V3f at(float place) const;

 private:
  V3f between(float place) const;

  const StripPaintParams& params_;
};

}  // namespace kagefude
