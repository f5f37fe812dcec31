#pragma once

#include <cstdint>
#include <span>

#include "image/plane.h"
#include "passes/tone/tone.h"

namespace kagefude {

/// What is bright without the lights, in parts of what is white under all of them.
struct ToneFloor {
  float world = 0;               ///< irradiance of the world's light
  View<const float> emission{};  ///< radiance of each pixel's surface; may be empty
  float emissionUnit = 0;        ///< what the emission is multiplied by: pi / white's irradiance
};

/// Share of all light that the world's is: s / (1 + s), s = tone.world times the floor's world.
float worldShare(const ToneParams& params, float world);

/// **[ours]** Adds the ambient light I0 of 004's sum to a tone, so that what all lights reach stays
/// white: with f = worldShare, c becomes f + (1 - f) (c + tone.emission x unit x emission), not
/// above 1. A pixel of index i > 0 takes perAnchor[i - 1]; index 0 and indices beyond the list keep
/// their tone. Emission below 0 or NaN counts as 0. In place.
void raiseTone(View<float> tone, View<const uint16_t> anchorIndex,
               std::span<const ToneParams> perAnchor, const ToneFloor& floor);

}  // namespace kagefude
