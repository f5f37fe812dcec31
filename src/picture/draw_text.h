#pragma once

#include <string>

#include "image/plane.h"

namespace kagefude {

/// Draws one line of text in white into a grey picture (0..1), its baseline starting at (x, y),
/// `size` pixels high; what falls outside is cut off. Throws InputError when no usable font is
/// installed.
void drawText(View<float> picture, int x, int y, int size, const std::string& text);

}  // namespace kagefude
