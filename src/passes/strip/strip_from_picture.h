#pragma once

#include "passes/strip/strip_paint.h"

namespace kagefude {

/// A rectangle of a picture, pixels from its upper left.
struct PicturePatch {
  int x = 0, y = 0, width = 0, height = 0;
};

struct FromPictureParams {
  int width = 512, height = 512;  ///< of the strip
  float hueShift = 0;             ///< as StripPaintParams::hueShift
  float strokes = 1;              ///< strength of the strokes against the picture's own
};

/// **[ours]** A strip with the tones and the strokes of a picture (display-encoded sRGB planes of
/// equal size): its rows are the picture's tones by lightness (Oklab), from the 1st to the 99th
/// percentile, each of the mean colour of the pixels about that light; its strokes are what of the
/// picture's lightness is finer than a twelfth of the patch, made even in strength (local root mean
/// square), turned so that they run along the row (the smaller of the mean squared differences
/// along and across), laid once over the strip with a quarter of its width blended into the
/// beginning so that the ends join. Each row's strokes have mean 0, so rows rise steadily, and
/// about the strength that they have in the picture at that tone; their colours are the tones' own.
/// Non-finite texels count as 0. Throws InputError below 16 x 16 pixels and when lightness differs
/// by less than 0.05. Cost: a few passes over patch and strip.
PaintedStrip stripFromPicture(View<const float> r, View<const float> g, View<const float> b,
                              const FromPictureParams& params);

}  // namespace kagefude
