#pragma once

#include <OpenEXR/ImfForward.h>

#include "exr/image_file.h"

namespace kagefude::detail {

/// Copies what a source's headers say of the picture into an output's header, bit for bit: all that
/// the first own part says, and with `allParts` what the others say too (see OutputImage). What
/// describes storage stays behind; a file of several views leaves the name of the one that was
/// taken as `view`.
void carryAttributes(const ImageFile& source, bool allParts, Imf::Header& header);

}  // namespace kagefude::detail
