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

}  // namespace kagefude
