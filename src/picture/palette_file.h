#pragma once

#include <filesystem>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// The colours of a palette in the file's order, display-encoded sRGB.
///
/// `.gpl` is GIMP's text ("GIMP Palette", then lines of red, green, blue 0..255 and a name); `.ase`
/// is Adobe's Swatch Exchange (big-endian blocks; RGB, Gray and LAB, which is taken as CIE L*a*b*
/// under D50 and brought to sRGB by Bradford's adaptation). Told by the first bytes. Throws
/// InputError when it is missing, above 1 MiB, neither, cut, holds CMYK (which no sRGB follows from
/// without its profile) or holds no colour or more than 4096.
std::vector<V3f> readPalette(const std::filesystem::path& path);

/// The same of a list as one types it: #rrggbb or rrggbb or #rgb, with commas or spaces between.
/// Throws UsageError naming what is no colour.
std::vector<V3f> paletteFromText(const std::string& text);

}  // namespace kagefude
