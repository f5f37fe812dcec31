#pragma once

#include <string>
#include <vector>

#include "look/look_sections.h"

namespace kagefude {

/// One entry of style.light_strips: NAME=STRIP.
struct LightStrip {
  std::string light;  ///< name or glob
  std::string strip;  ///< "" counts the light in the style's own strip
};

/// The entry's parts, split at its first "="; a text without one is a light's name.
LightStrip lightStripFrom(const std::string& entry);
std::vector<LightStrip> lightStripsOf(const StyleParams& style);

/// Throws LookError where an entry lacks its light or its "=", or has the light of another.
void checkLightStrips(const StyleParams& style);

/// The strip of its own that a light is painted with on a style's surfaces: of the style's entries
/// the first that fits its name, else the strip of the last [[light]] that does; "" for none.
std::string stripOfLight(const Look& look, const StyleParams& style, const std::string& light);

}  // namespace kagefude
