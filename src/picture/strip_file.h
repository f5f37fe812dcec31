#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "image/plane.h"

namespace kagefude {

/// A strip picture as the file holds it, upright, in the file's own colour space. Integer types are
/// scaled to 0..1. One grey channel fills all three. `alpha` is 1 where the file has none.
struct StripPicture {
  Floats red, green, blue, alpha;
  bool hasAlpha = false;
  bool associated = false;   ///< colours are multiplied by alpha: EXRs' are, PNGs' are not, others
                             ///< say it themselves
  bool sceneLinear = false;  ///< by what the file says; where it says nothing, floats are
  std::string space;         ///< as the file names it (OpenImageIO's name); "" when it does not
  int width() const { return red.width(); }
  int height() const { return red.height(); }
};

/// Reads a strip from a picture of any format that OpenImageIO reads: a PNG or EXR, told by its
/// first bytes, by the program itself, others by the worker (see picture_file.h). Throws InputError
/// when it is missing, unreadable, truncated, deep, in CMYK, not of 1 to 4 channels, above 64
/// megapixels, of an absurd claim (checkClaim) or of a format that is refused by name; `what` is
/// what its messages call the file.
StripPicture readStrip(const std::filesystem::path& path, std::string_view what = "strip");

}  // namespace kagefude
