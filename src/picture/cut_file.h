#pragma once

#include <cstdint>
#include <filesystem>

#include "picture/picture_header.h"

namespace kagefude {

/// Whether a picture's file ends before its pixels do, for the formats whose decoders then hand out
/// black or grey without a word (TIFF, JPEG, IFF, DDS, DPX, Cineon as of OpenImageIO 2.4), or whose
/// encoder does not hear of a full disk (PNG). False for others.
bool isCutShort(const std::filesystem::path& path, const PictureHeader& header, uint64_t fileBytes);

}  // namespace kagefude
