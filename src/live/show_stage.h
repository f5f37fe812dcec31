#pragma once

#include <string>
#include <vector>

#include "live/live_frame.h"

namespace kagefude {

/// The names of a picture's stages, in the order in which a frame runs through them; the result
/// comes last. Those of a light end in its name.
std::vector<std::string> stageNames(const LivePicture& picture);

/// Pixels as a browser's canvas takes them: R, G, B, A, a byte each, row by row; A is 255.
struct ShownPixels {
  int width = 0, height = 0;
  std::string bytes;
};

/// How pictures are looked at.
struct Viewing {
  float exposure = 0;             ///< stops
  std::string display{}, view{};  ///< of the colour configuration; "" for the look's own
};

/// A stage as the display shows it: pictures through display and view (on black) after `exposure`;
/// numbers as grey from 0 to 1; labels in distinct colours; vectors as 0.5 + 0.5 n. Throws
/// InputError when the picture has no such stage, LookError for an unknown display or view. Cost:
/// for pictures OCIO's transform of every pixel.
ShownPixels showStage(const LivePicture& picture, const std::string& stage,
                      const Viewing& viewing = {});

/// Colours of the working space as the display shows them. Throws LookError for an unknown display
/// or view.
ShownPixels showColours(const LivePicture& picture, const Vec3View& colour, const Viewing& viewing);

/// Colours that are display-encoded already, as they are.
ShownPixels showPainted(View<const float> red, View<const float> green, View<const float> blue);

}  // namespace kagefude
