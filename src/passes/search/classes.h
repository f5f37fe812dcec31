#pragma once

#include <cstdint>
#include <span>

#include "image/plane.h"

namespace kagefude {

/// What a pixel is in the light of several hard masks (000 section 3.2).
enum class ShadowClass : uint8_t { background = 0, umbra = 1, penumbra = 2, lit = 3 };

/// Class of every pixel, as a ShadowClass in a byte: umbra where every mask hides the light, lit
/// where every mask sees it, penumbra where they disagree, background where the label is 0.
///
/// masks: 0 = the light is hidden, anything else = seen. One mask gives no penumbra. Throws
/// InputError without masks or when a mask's size is not the labels'. Cost: one read of each plane.
Bytes classifyShadow(std::span<const View<const uint8_t>> masks, View<const uint32_t> labels);

}  // namespace kagefude
