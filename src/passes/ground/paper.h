#pragma once

#include <string_view>
#include <vector>

#include "base/parameter.h"

namespace kagefude {

struct PaperParams {
  enum class Kind { rough, canvas, laid };
  enum class Fixed { screen, world };
  float strength = 0;
  Kind kind = Kind::rough;
  float grain = 5;
  float pressure = 0.6f;
  float byTone = 0.5f;
  float relief = 0.3f;
  std::vector<float> colour = {0.83f, 0.79f, 0.70f};
  Fixed fixed = Fixed::screen;
};

inline constexpr std::string_view paperKinds[] = {"rough", "canvas", "laid"};
inline constexpr std::string_view paperFixings[] = {"screen", "world"};
inline constexpr Parameter paperParameters[] = {
    number<&PaperParams::strength>("strength", 0, 1, "",
                                   "How much the paper's tooth takes and refuses the paint: its "
                                   "hollows stay bare where the brush presses lightly; 0 paints as "
                                   "on glass."),
    choice<&PaperParams::kind>("kind", paperKinds,
                               "Rough watercolour paper, woven canvas, or paper with laid lines."),
    number<&PaperParams::grain>("grain", 1.5, 256, "pixels",
                                "Width of the tooth: of a bump, a thread or a laid line."),
    number<&PaperParams::pressure>("pressure", 0, 1, "",
                                   "How hard the brush presses at middle tones: the share of the "
                                   "paper that takes paint."),
    number<&PaperParams::byTone>("by_tone", -1, 1, "",
                                 "How much more of the paper dark tones cover than bright ones; "
                                 "negative: bright ones cover more, as with chalk on a dark "
                                 "ground."),
    number<&PaperParams::relief>("relief", 0, 1, "",
                                 "How much the tooth is seen by its own light and shade, also "
                                 "under the paint; only with strength above 0 or background = "
                                 "\"paper\"."),
    numbers<&PaperParams::colour>("colour", 3, 0, 100, "scene-linear",
                                  "Colour r, g, b of the bare paper."),
    choice<&PaperParams::fixed>("fixed", paperFixings,
                                "Whether the tooth stands still on the screen, or lies on the "
                                "objects and, behind them, on the directions of view."),
};
inline constexpr ParameterTable paperTable{"paper", "Paper or canvas whose tooth takes the paint.",
                                           "ours", paperParameters};

}  // namespace kagefude
