#pragma once

#include <span>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// One tone of a ramp that a painter would mix from a thing's own colour: its lightness (Oklab) is
/// `lift` + `scale` times the own one, its chroma `chroma` times.
struct TonePoint {
  float place = 0;  ///< 0 dark to 1 bright
  float lift = 0, scale = 1, chroma = 1;
  float lean = 0;  ///< degrees towards warm, below 0 towards cool, see leanTowardsWarm
};

/// **[ours]** The stops of a strip (StripPaintParams::stops) for a thing of that colour, linear
/// Rec. 709: the points' tones of it, as display-encoded sRGB; what cannot be shown loses chroma,
/// not hue. Points rise from place 0 to place 1.
std::vector<float> tonesOf(const V3f& linearColour, std::span<const TonePoint> ramp);

/// **[ours]** The stops of a strip whose tones are a palette's colours (display-encoded sRGB): by
/// rising lightness (Oklab), each with the same share of the strip, mixed in Oklab in between
/// (eight stops from one to the next). Colours of one lightness keep their order. Throws InputError
/// when all are within 0.05 of one lightness; a single colour, too.
std::vector<float> stopsOfPalette(std::vector<V3f> encoded);

}  // namespace kagefude
