#pragma once

#include <vector>

#include "base/parameter.h"
#include "image/vec.h"

namespace kagefude {

/// [tint]: how the colours of lights and of the shadow change those of the paint.
struct TintParams {
  float light = 0;
  std::vector<float> shadow;
  float shadowStrength = 0.5f;

  bool acts() const { return light > 0 || (!shadow.empty() && shadowStrength > 0); }
};

inline constexpr Parameter tintParameters[] = {
    number<&TintParams::light>("light", 0, 1, "",
                               "How far the lights' own colours tint what they light; 1 is as much "
                               "as they do in the render, brightness kept."),
    numbers<&TintParams::shadow>("shadow", 3, 0, 100, "scene-linear",
                                 "Colour r, g, b that shadows turn to, brightness kept; empty: "
                                 "none."),
    number<&TintParams::shadowStrength>("shadow_strength", 0, 1, "",
                                        "How far the darkest tone turns to it."),
};
inline constexpr ParameterTable tintTable{"tint", "Warm light and cool shadow.", "ours",
                                          tintParameters};

/// Of Rec. 709.
inline float luminanceOf(const V3f& colour) {
  return 0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z;
}

/// **[ours]** A paint's colour under a light of colour `light` (luminance 1) at a tone 0..1: times
/// 1 + light_share (light - 1), then times 1 + s (shadow - 1), s = shadow_strength (1 - tone), the
/// shadow's colour at luminance 1; after each as bright as before, but for colours that the other
/// takes to less than a quarter. A tone that is NaN counts as 0.
V3f tinted(const V3f& colour, const V3f& light, float tone, const TintParams& params);

}  // namespace kagefude
