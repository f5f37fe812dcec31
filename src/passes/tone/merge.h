#pragma once

#include <span>

#include "base/parameter.h"
#include "image/plane.h"

namespace kagefude {

struct MergeParams {
  enum class Mode { subtract, product, minimum };
  enum class Lights { sum, maximum, screen };
  Mode mode = Mode::subtract;
  Lights lights = Lights::sum;
};

inline constexpr std::string_view mergeModes[] = {"subtract", "product", "minimum"};
inline constexpr std::string_view mergeLights[] = {"sum", "maximum", "screen"};
inline constexpr Parameter mergeParameters[] = {
    choice<&MergeParams::mode>("mode", mergeModes,
                               "How soft shadow a and shade b make one tone: max(0, a + b - 1), "
                               "a b, or the smaller."),
    choice<&MergeParams::lights>("lights", mergeLights,
                                 "How the tones of several lights add up: clamped sum, the "
                                 "brightest, or screen."),
};
inline constexpr ParameterTable mergeTable{"merge", "Shadow and shade, and several lights, in one.",
                                           "002 eq. 4.8", mergeParameters};

/// Tone c of soft shadow a (visibility) and shade b, both 0..1: max(0, a + b - 1) (002 eq. 4.8),
/// or their product, or the smaller. NaN gives 0. `tone` may be either input.
void mergeTone(View<const float> visibility, View<const float> shade, const MergeParams& params,
               View<float> tone);

/// **[ours]** Tone of several lights, each light's tone times its weight: clamped sum, the
/// brightest, or 1 - Π(1 - w c). Result 0..1; no lights give 0; NaN counts as 0. Lights are taken
/// in the given order at every pixel, so the bits do not depend on threads.
void combineTones(std::span<const View<const float>> perLight, std::span<const float> weights,
                  const MergeParams& params, View<float> tone);

}  // namespace kagefude
