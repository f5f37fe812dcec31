#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"

namespace kagefude {

/// [ground]: what output.background paints behind things.
struct GroundParams {
  enum class Row { height, view, beauty };
  enum class Fixed { screen, world };
  std::vector<float> colour = {0.42f, 0.37f, 0.29f};
  std::string picture;
  std::string strip = "builtin:soft";
  Row row = Row::height;
  float low = 0.85f;
  float high = 0.45f;
  float width = 40;
  Fixed fixed = Fixed::screen;
};

inline constexpr std::string_view groundRows[] = {"height", "view", "beauty"};
inline constexpr std::string_view groundFixings[] = {"screen", "world"};
inline constexpr Parameter groundParameters[] = {
    numbers<&GroundParams::colour>("colour", 3, 0, 100, "scene-linear",
                                   "Colour r, g, b of background = \"colour\"."),
    plain<&GroundParams::picture>("picture",
                                  "Picture of background = \"picture\", relative to the look; it "
                                  "fills the frame and keeps its shape."),
    plain<&GroundParams::strip>("strip",
                                "Strip of background = \"strip\", as style.strip names one."),
    choice<&GroundParams::row>("row", groundRows,
                               "What picks the strip's row behind things: the height in the "
                               "picture, the direction of view from the horizon to straight up, "
                               "or how bright the beauty is there."),
    number<&GroundParams::low>("low", 0, 1, "tone",
                               "Row of the strip at the picture's foot, or at the horizon and "
                               "below; 1 is the brightest. Not with row = \"beauty\"."),
    number<&GroundParams::high>("high", 0, 1, "tone",
                                "Row of the strip at the picture's head, or straight up. Not with "
                                "row = \"beauty\"."),
    number<&GroundParams::width>("width", 1, 360, "degrees",
                                 "How much of the view one width of the strip takes in the middle "
                                 "of the picture; a picture without a camera counts as 40 wide."),
    choice<&GroundParams::fixed>("fixed", groundFixings,
                                 "Whether the strip's strokes stand still on the screen, or on the "
                                 "directions of view as the sky does."),
};
inline constexpr ParameterTable groundTable{"ground", "What is painted behind things.", "ours",
                                            groundParameters};

}  // namespace kagefude
