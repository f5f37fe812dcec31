#pragma once

#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "image/plane.h"

namespace kagefude {

struct StripPaintParams {
  int width = 512;
  int height = 512;
  float strokeWidth = 64;
  float strokeLength = 200;
  float spacing = 0.35f;
  float opacity = 0.8f;
  float hardness = 0.85f;
  float pressure = 0.5f;
  float wobble = 0.12f;
  float bristle = 0.5f;
  float jitter = 0.06f;
  float under = 0;
  float relief = 0;
  float tooth = 0;
  float toothSize = 3;
  float pool = 0;
  int hatch = 0;
  std::vector<float> ink{0.09f, 0.08f, 0.10f};
  float hueShift = 0;
  int bands = 0;
  int seed = 1;
  std::vector<float> stops{0.00f, 0.10f, 0.09f, 0.20f, 0.30f, 0.33f, 0.21f, 0.36f, 0.60f, 0.76f,
                           0.45f, 0.38f, 0.85f, 0.95f, 0.76f, 0.58f, 1.00f, 1.00f, 0.95f, 0.84f};
};

inline constexpr Parameter stripParameters[] = {
    number<&StripPaintParams::width>("width", 8, 16384, "pixels", "Width of the strip."),
    number<&StripPaintParams::height>("height", 8, 16384, "pixels", "Height of the strip."),
    number<&StripPaintParams::strokeWidth>("stroke_width", 1, 4096, "pixels",
                                           "Diameter of the round brush at full pressure."),
    number<&StripPaintParams::strokeLength>("stroke_length", 4, 65536, "pixels",
                                            "Mean length of a stroke along its row."),
    number<&StripPaintParams::spacing>("spacing", 0.05, 2, "stroke widths",
                                       "Step from one row of strokes to the next."),
    number<&StripPaintParams::opacity>("opacity", 0.05, 1, "",
                                       "How much a stroke at full pressure covers."),
    number<&StripPaintParams::hardness>("hardness", 0, 1, "",
                                        "Share of the brush's radius inside its soft edge."),
    number<&StripPaintParams::pressure>("pressure", 0, 1, "",
                                        "How far the pen's pressure, and with it width and "
                                        "opacity, varies along a stroke."),
    number<&StripPaintParams::wobble>("wobble", 0, 1, "stroke widths",
                                      "How far the hand strays from the row."),
    number<&StripPaintParams::bristle>("bristle", 0, 1, "",
                                       "Depth of the streaks that the bristles leave."),
    number<&StripPaintParams::jitter>("jitter", 0, 0.5, "of the range",
                                      "How far a stroke's colour strays along the gradient."),
    number<&StripPaintParams::under>("under", -1, 1, "of the range",
                                     "How much brighter (below 0: darker) the ground is that shows "
                                     "between strokes."),
    number<&StripPaintParams::relief>("relief", 0, 1, "",
                                      "How thick the paint lies: light from above catches its "
                                      "ridges, and what the bristles leave."),
    number<&StripPaintParams::tooth>("tooth", 0, 1, "",
                                     "Roughness of the paper, whose hollows dry strokes leave "
                                     "free."),
    number<&StripPaintParams::toothSize>("tooth_size", 1, 256, "pixels",
                                         "Size of the paper's grain."),
    number<&StripPaintParams::pool>("pool", 0, 1, "",
                                    "How much darker a wash dries along the rims of its strokes."),
    number<&StripPaintParams::hatch>(
        "hatch", 0, 2, "",
        "Pen lines in place of strokes, stroke_width apart, thicker the darker: 1 along the row, 2 "
        "crossed in the dark. The last stop is the paper, the others say how much ink."),
    numbers<&StripPaintParams::ink>("ink", 3, 0, 1, "",
                                    "Colour of pen lines: red, green, blue in display-encoded "
                                    "sRGB."),
    number<&StripPaintParams::hueShift>(
        "hue_shift", -90, 90, "degrees",
        "How far colours lean to yellow in the light and to blue in "
        "the shadow; below 0 the other way round."),
    number<&StripPaintParams::bands>("bands", 0, 64, "",
                                     "Flat bands of a cel look, strokes showing at the steps "
                                     "only; 0 paints a gradient."),
    number<&StripPaintParams::seed>("seed", 0, 2147483647, "", "Another seed, other strokes."),
    numbers<&StripPaintParams::stops>("stops", 0, 0, 1, "",
                                      "Colour stops from dark to bright, each as place, red, "
                                      "green, blue in display-encoded sRGB."),
};
inline constexpr ParameterTable stripTable{"strip", "A strip painted from a few colour stops.",
                                           "002 §2.2", stripParameters};

/// Display-encoded sRGB colour, 0..1; row 0 is the brightest.
struct PaintedStrip {
  Floats r, g, b;
};

/// Paints a strip as the seed describes (002 §2.2): take the row's colour, draw round strokes along
/// the row where the colour does not change, step to the next row, from dark at the bottom to
/// bright at the top; strokes overlap and cover only in part. **[ours]** Strokes are of finite
/// length with round ends, and pressure, path, colour and bristles vary a little along each, from
/// `seed` alone: the same bits everywhere. Left and right edges join: strokes run across them.
/// With `bands`, colours come in flat bands taken at the bands' middles.
/// Throws LookError unless there are at least two stops whose places rise from 0 to 1.
/// Cost: about π/4 · height / (spacing · stroke_width) · 2 brush areas a column; 512² takes 0.1 s.
PaintedStrip paintStrip(const StripPaintParams& params);

/// The parameters of the strips that are shipped: "neutral" (greys, warm in the light and cool in
/// the shadow, to be multiplied with a surface's own colour), "soft" (wide soft strokes), "fine"
/// (fine strokes), "cel" (flat bands with strokes at the steps). Throws UsageError for any other
/// name.
StripPaintParams stripPreset(std::string_view name);
inline constexpr std::string_view stripPresets[] = {"neutral", "soft", "fine", "cel"};

}  // namespace kagefude
