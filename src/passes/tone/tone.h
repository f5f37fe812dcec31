#pragma once

#include <cstdint>
#include <span>

#include "base/parameter.h"
#include "image/plane.h"

namespace kagefude {

/// What of a light counts in the tone.
enum class ToneLight { shade, irradiance };
inline constexpr std::string_view toneLightNames[] = {"shade", "irradiance"};

struct ToneParams {
  ToneLight light = ToneLight::shade;
  float black = 0;
  float white = 1;
  float gamma = 1;
  float world = 0;
  float emission = 0;
};

inline constexpr Parameter toneParameters[] = {
    choice<&ToneParams::light>(
        "light", toneLightNames,
        "what of a light counts: the angle at which it falls in, or all of its irradiance, with "
        "its falloff and the luminance of its colour; 1 is what all lights give the subject."),
    number<&ToneParams::black>("black", -1, 1, "tone", "Tone that becomes the darkest row."),
    number<&ToneParams::white>("white", 0, 2, "tone", "Tone that becomes the brightest row."),
    number<&ToneParams::gamma>("gamma", 0.05, 20, "",
                               "Power by which middle tones are lifted: above 1 brighter, below 1 "
                               "darker."),
    number<&ToneParams::world>(
        "world", 0, 1, "",
        "How much of the world's own light, as even as it comes, lifts the tone of what the lights "
        "do not reach; its radiance is the JSON's, or scene.world."),
    number<&ToneParams::emission>(
        "emission", 0, 100, "",
        "How much of what surfaces give off themselves (the frame's Emission pass, where it has "
        "one) lifts their tone; at 1 a surface that shines as a white one does in full light is as "
        "bright."),
};
inline constexpr ParameterTable toneTable{
    "tone", "Levels and gamma between the tone and the strip's rows.", "ours", toneParameters};

/// **[ours]** Levels as paint programs have them: ((c - black) / (white - black))^(1/gamma),
/// clamped to [0, 1]. white <= black makes a hard step: 1 where c >= white. NaN gives 0.
float adjustTone(float tone, const ToneParams& params);

/// The same on a whole plane, in place.
void adjustTone(View<float> tone, const ToneParams& params);

/// The same with one setting a style: a pixel of index i > 0 takes perAnchor[i - 1]; index 0 and
/// indices beyond the list keep their tone.
void adjustTone(View<float> tone, View<const uint16_t> anchorIndex,
                std::span<const ToneParams> perAnchor);

}  // namespace kagefude
