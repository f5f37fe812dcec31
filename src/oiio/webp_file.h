#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace kagefude::oiio {

// OpenImageIO 2.4 writes WebP without metadata, always in chroma at half size, and divides colours
// by alpha in a gamma of its own after rounding them to 8 bits; and it reads no metadata. Its own
// library does better.

/// Writes 3 or 4 interleaved channels, 0..1, colours not multiplied by alpha, with the spec's
/// attributes as Exif. CompressionQuality of 100 is lossless. Throws std::runtime_error.
void writeWebp(const std::string& path, const OIIO::ImageSpec& spec, const float* pixels);

/// Adds what the file's Exif says to `spec`. A file without is left alone.
void addWebpMetadata(const std::string& path, OIIO::ImageSpec& spec);

}  // namespace kagefude::oiio
