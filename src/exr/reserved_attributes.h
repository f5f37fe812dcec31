#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace kagefude {

/// Header attributes that follow from the image itself, so that nobody sets them by name.
inline constexpr std::array<std::string_view, 13> reservedAttributes = {
    "channels",          "compression",        "dataWindow", "displayWindow", "lineOrder",
    "pixelAspectRatio",  "screenWindowCenter", "type",       "name",          "version",
    "screenWindowWidth", "chunkCount",         "tiles"};

constexpr bool isReservedAttribute(std::string_view name) {
  return std::find(reservedAttributes.begin(), reservedAttributes.end(), name) !=
         reservedAttributes.end();
}

}  // namespace kagefude
