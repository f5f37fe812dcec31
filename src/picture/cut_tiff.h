#pragma once

#include <cstdint>
#include <filesystem>

namespace kagefude {

/// Whether a strip or tile of the first picture in a TIFF (classic or BigTIFF, either byte order)
/// ends behind the file. OpenImageIO 2.4 says nothing of it for LZW and plain strips and for small
/// pictures. False for what is no TIFF: the decoder says that. Reads the directory alone, in the
/// file's bounds. Source: TIFF 6.0, section 2; BigTIFF, 2007.
bool tiffIsCutShort(const std::filesystem::path& path, uint64_t fileBytes);

}  // namespace kagefude
