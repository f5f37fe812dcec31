#pragma once

#include <string_view>

#include "colour/colour.h"

namespace kagefude {

/// Colours of the working space as bytes for a screen: what toDisplay gives for 2^exposure times
/// them, held within 0 and 1, times 255, rounded; NaN is 0. Four bytes a pixel, R, G, B and 255;
/// `bytes` holds them. The very bytes of toDisplay, for views that treat each channel for itself by
/// a table of it, which takes a fifth of the time: a pixel that lies in a cell of the table whose
/// ends are two bytes is transformed. (So it is only of a view that goes up and down again within
/// 1/4096 of a value that a byte may be missed.) Throws as toDisplay.
void displayBytes(const Colour& colour, View<const float> red, View<const float> green,
                  View<const float> blue, float exposure, std::string_view display,
                  std::string_view view, char* bytes);

}  // namespace kagefude
