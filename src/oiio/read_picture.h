#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <vector>

#include "picture/picture_header.h"

namespace kagefude::oiio {

/// What a plane of pixels is made as: the bits of a half, a float (integers scaled to 0..1), or
/// whole numbers as the file has them.
enum class PlaneType { half, single, whole };

/// A file that is being read.
struct OpenedPicture {
  std::unique_ptr<OIIO::ImageInput> input;
  PictureHeader header;
};

/// Opens a picture and tells what it is. Throws std::runtime_error with OpenImageIO's words.
OpenedPicture openPicture(const std::string& path);

/// One channel to be read and where its plane begins: rows without gaps, 2 bytes a pixel for halves
/// and 4 for the others.
struct WantedPlane {
  int channel = 0;
  PlaneType type = PlaneType::single;
  size_t offset = 0;
};

/// Decodes the top mip level of the first picture into `planes`. Throws std::runtime_error.
void readPlanes(OpenedPicture& picture, const std::vector<WantedPlane>& wanted, std::byte* planes);

}  // namespace kagefude::oiio
