#pragma once

#include <string>

#include "picture/picture_header.h"

namespace kagefude::oiio {

/// What is written, and where.
struct WrittenPicture {
  std::string path;          ///< of the temporary
  std::string name;          ///< that the file will have; some headers hold it
  std::string metadataFile;  ///< whose attributes go along; "" for none
  int metadataPart = 0;
  PictureHeader header;
};

/// Writes interleaved floats as a picture of the header's format, size, channels, sample type and
/// attributes. The same bytes for the same values, whenever and wherever it is written. Throws
/// std::runtime_error with OpenImageIO's words.
void writePicture(const WrittenPicture& picture, const float* pixels);

}  // namespace kagefude::oiio
