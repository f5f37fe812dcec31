#pragma once

#include "base/parameter.h"

namespace kagefude {

struct BrushParams {
  enum class Mapping { held, polar, seed };
  enum class Grain { object, tone };
  enum class CrossFade { variance, linear };
  enum class Filter { anisotropic, bilinear };
  enum class Size { object, screen };
  enum class Ground { rest, object, uv };
  enum class Stretch { skin, world };
  Mapping mapping = Mapping::held;
  Grain grain = Grain::object;
  CrossFade crossFade = CrossFade::variance;
  Filter filter = Filter::anisotropic;
  Size size = Size::object;
  Ground ground = Ground::rest;
  Stretch stretch = Stretch::skin;
  float uvSize = 0;
  float mappingDistance = 0;
  float stripPixels = 512;
  float blendWidth = 0.5f;
  float poleFade = 0.5f;
  float contrast = 1;
  int maxProbes = 8;
  int points = 0;
  float pointBlend = 0.6f;
  float smoothNormals = 0;
  bool diagnostics = false;
  /// Whether the strokes' grain is kept beside their colours, mean 0 and variance 1: that of
  /// object grain, else the root of the luminance against its row's mean, in tenths. 0 where
  /// nothing is painted.
  bool keepsGrain = false;
};

inline constexpr std::string_view brushMappings[] = {"held", "polar", "seed"};
inline constexpr std::string_view brushGrains[] = {"object", "tone"};
inline constexpr std::string_view brushCrossFades[] = {"variance", "linear"};
inline constexpr std::string_view brushFilters[] = {"anisotropic", "bilinear"};
inline constexpr std::string_view brushSizes[] = {"object", "screen"};
inline constexpr std::string_view brushGrounds[] = {"rest", "object", "uv"};
inline constexpr std::string_view brushStretches[] = {"skin", "world"};
inline constexpr Parameter brushParameters[] = {
    choice<&BrushParams::mapping>("mapping", brushMappings,
                                  "Where a stroke's place along its row comes from: held to the "
                                  "object's own axes, the angle round the light's axis, or the "
                                  "seed's formulas to the letter (mended)."),
    choice<&BrushParams::grain>("grain", brushGrains,
                                "Of held strokes: whether they stay on the object and the tone "
                                "picks their colours, or run along the tone's contours and slide "
                                "as it changes."),
    choice<&BrushParams::crossFade>("cross_fade", brushCrossFades,
                                    "How two stroke patterns mix: keeping the strip's contrast, "
                                    "or linearly."),
    choice<&BrushParams::filter>("filter", brushFilters,
                                 "How the strip is read: averaged over the pixel's footprint, or "
                                 "at one point."),
    choice<&BrushParams::size>("size", brushSizes,
                               "Whether strokes keep their size on the object or on the screen."),
    choice<&BrushParams::ground>("ground", brushGrounds,
                                 "What strokes are held to: the surface as it rests, so that they "
                                 "stay on skin that deforms (where the frame has a Rest pass, else "
                                 "as object); the object's own axes; or its UVs (held strokes "
                                 "only)."),
    choice<&BrushParams::stretch>("stretch", brushStretches,
                                  "Of held strokes on rest positions or UVs: whether they stretch "
                                  "with the skin, or keep about their size in the world, in "
                                  "octaves that fade into each other."),
    number<&BrushParams::uvSize>("uv_size", 0, 1e6, "world units",
                                 "With ground = uv: how much surface one unit of UV counts for; 0 "
                                 "takes the object's longest side."),
    number<&BrushParams::mappingDistance>("mapping_distance", 0, 1e6, "world units",
                                          "Distance from the axis at which the strip goes round "
                                          "once; 0 takes a quarter of the object's half size."),
    number<&BrushParams::stripPixels>("strip_pixels", 8, 65536, "pixels",
                                      "With size = screen: pixels that one width of the strip "
                                      "covers at the reference point."),
    number<&BrushParams::blendWidth>("blend_width", 0, 1, "rings",
                                     "Share of a ring over which polar and seed strokes change to "
                                     "the next repeat count."),
    number<&BrushParams::poleFade>("pole_fade", 0, 4, "rings",
                                   "Distance from the axis within which polar strokes fade in."),
    number<&BrushParams::contrast>("contrast", 0, 4, "",
                                   "Strength of the strokes against their row's mean colour."),
    number<&BrushParams::maxProbes>("max_probes", 1, 64, "lookups",
                                    "Most lookups along a stretched footprint; beyond it strokes "
                                    "are blurred."),
    number<&BrushParams::points>("points", 0, 16, "",
                                 "Automatic reference points along the object's long side; 0 "
                                 "takes one for each width that the length holds."),
    number<&BrushParams::pointBlend>("point_blend", 0.01, 1, "gaps",
                                     "Share of the gap between two reference points over which "
                                     "one hands over to the other."),
    number<&BrushParams::smoothNormals>("smooth_normals", 0, 1, "strip widths",
                                        "Round how much of the surface normals are averaged before "
                                        "strokes take their direction from them, so that large "
                                        "strokes run on over fine bumps; 0 takes them as they "
                                        "are."),
};
inline constexpr ParameterTable brushTable{"brush", "Strokes from a painted strip along the tone.",
                                           "002 eq. 3.2-3.11", brushParameters};

}  // namespace kagefude
