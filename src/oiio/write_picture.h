#pragma once

#include <string>

#include "picture/picture_header.h"

namespace kagefude::oiio {

/// Writes interleaved floats as a picture of `header`'s format, size, channels, sample type and
/// attributes. Throws std::runtime_error with OpenImageIO's words.
void writePicture(const std::string& path, const PictureHeader& header, const float* pixels);

}  // namespace kagefude::oiio
