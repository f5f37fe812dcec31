#pragma once

#include <filesystem>

#include "exr/image_file.h"

namespace kagefude {

/// The header of a frame, or of one of its groups of channels, in any format: an EXR, told by its
/// first bytes, as openImage has it; other pictures as an image of one part without a name, whose
/// text attributes are those of OpenImageIO. Integers read as floats are scaled to 0..1; read as
/// bits they are the whole numbers of the file (ids), so their channels are of type uint. Throws
/// InputError as openImage and PictureFile do.
ImageFile openAnyImage(const std::filesystem::path& path);

}  // namespace kagefude
