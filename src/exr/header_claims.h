#pragma once

#include <cstdint>
#include <filesystem>

namespace kagefude {

/// Walks over the headers of an EXR file before a library reads them: every attribute says how many
/// bytes it has, and OpenEXR allocates as many (up to 2 GiB) before it finds that the file ends. A
/// claim beyond the file's end is an InputError that names the attribute, and so is a list of
/// channels that is not sorted, or has one twice, with the part and the channel: libraries sort it,
/// and would take the pixels of one channel for those of another. What is no EXR at all, or broken
/// otherwise, is left to the library to say. Cost: the header's bytes, read once.
void checkHeaderClaims(const std::filesystem::path& path, uint64_t fileBytes);

/// Whether all chunks of an EXR file lie within it: false for a file that was cut. Reads the
/// header, the chunk table and eight bytes a chunk. InputError when it cannot be read at all.
bool isWholeExr(const std::filesystem::path& path);

}  // namespace kagefude
