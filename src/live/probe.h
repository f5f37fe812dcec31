#pragma once

#include <nlohmann/json_fwd.hpp>

#include "live/live_frame.h"

namespace kagefude {

/// What lies at a pixel of the picture (of its painted size; sampled as the picture is): object,
/// material, the number of the style that paints it (absent where none does), the strip and its row
/// from 0 to 1, tone, and each light's visibility. Outside the picture and on the background only
/// "object": null.
nlohmann::ordered_json probe(const LivePicture& picture, int x, int y);

}  // namespace kagefude
