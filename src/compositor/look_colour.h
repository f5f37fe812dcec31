#pragma once

#include "colour/colour.h"
#include "look/look.h"

namespace kagefude {

/// The colour configuration that a look names, or what stands for it without one. Throws as Colour
/// does, with colour.config and its place where the look names one.
Colour colourOf(const Look& look);

}  // namespace kagefude
