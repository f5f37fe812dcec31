#pragma once

#include <OpenImageIO/imagebuf.h>

#include "exr/image_file.h"

namespace kagefude {

/// A buffer as an image of one part, whose pixels are read out of it: it must live as long. Throws
/// InputError when it is deep, a volume, empty, or of other pixels than half, float and uint32.
ImageFile imageOfBuffer(const OIIO::ImageBuf& buffer);

}  // namespace kagefude
