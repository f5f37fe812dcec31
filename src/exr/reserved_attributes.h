#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace kagefude {

/// A header attribute of OpenEXR's own that does not pass from file to file, or not by name.
struct ReservedAttribute {
  std::string_view name;
  bool fromImage;  ///< follows from the image itself, so that nobody sets it by name
  bool ofStorage;  ///< says how its file was stored rather than what it shows; is not carried on
};

inline constexpr std::array<ReservedAttribute, 19> reservedAttributes = {{
    {"channels", true, true},
    {"compression", true, true},
    {"dataWindow", true, true},
    {"displayWindow", true, true},
    {"lineOrder", true, true},
    {"pixelAspectRatio", true, true},
    {"screenWindowCenter", true, false},
    {"screenWindowWidth", true, false},
    {"type", true, true},
    {"name", true, true},
    {"version", true, true},
    {"chunkCount", true, true},
    {"tiles", true, true},
    {"multiView", false, true},
    {"preview", false, true},
    {"envmap", false, true},
    {"maxSamplesPerPixel", false, true},
    {"deepImageState", false, true},
    {"dwaCompressionLevel", false, true},
}};

constexpr bool isFromImage(std::string_view name) {
  return std::any_of(reservedAttributes.begin(), reservedAttributes.end(),
                     [&](const ReservedAttribute& a) { return a.fromImage && a.name == name; });
}

constexpr bool isOfStorage(std::string_view name) {
  return std::any_of(reservedAttributes.begin(), reservedAttributes.end(),
                     [&](const ReservedAttribute& a) { return a.ofStorage && a.name == name; });
}

}  // namespace kagefude
