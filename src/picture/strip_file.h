#pragma once

#include <filesystem>

#include "image/plane.h"

namespace kagefude {

/// A strip picture as the file holds it, in the file's own colour space. Integer types are scaled
/// to 0..1. One grey channel fills all three. `alpha` is 1 where the file has none; an EXR's
/// colours are multiplied by it, a PNG's are not.
struct StripPicture {
  Floats red, green, blue, alpha;
  bool hasAlpha = false;
  bool sceneLinear = false;  ///< float file (EXR): most likely linear; integer files: sRGB
  int width() const { return red.width(); }
  int height() const { return red.height(); }
};

/// Reads a strip from a PNG or EXR, told by its first bytes. Throws InputError when it is missing,
/// of another format, unreadable, truncated, deep, above 64 megapixels or of an absurd claim
/// (checkClaim).
StripPicture readStrip(const std::filesystem::path& path);

}  // namespace kagefude
