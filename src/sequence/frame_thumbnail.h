#pragma once

#include <filesystem>

#include "colour/colour.h"
#include "image/vec.h"
#include "look/look.h"
#include "sequence/report.h"

namespace kagefude {

/// A composited picture as the report shows it: reduced to at most 320 pixels a side (each the mean
/// of those it covers, in the working space), through the look's display and view.
Thumbnail frameThumbnail(const Look& look, const Colour& colour, Vec3View picture);

/// The same of a frame on disk, by its R, G, B, which are display-ready when it is `shown`; empty
/// when it cannot be read.
Thumbnail storedThumbnail(const Look& look, const Colour& colour, const std::filesystem::path& path,
                          bool shown);

/// Writes a thumbnail as PNG. OutputError as writePng.
void writeThumbnail(const std::filesystem::path& path, const Thumbnail& thumbnail);

}  // namespace kagefude
