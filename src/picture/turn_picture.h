#pragma once

#include "image/plane.h"

namespace kagefude {

/// A plane turned upright from Exif's orientation, 1 to 8 (Exif 2.3, tag 274: which side of the
/// picture the stored rows begin at). Other numbers, and 1, leave it as it is.
Floats turnedUpright(Floats plane, int orientation);

}  // namespace kagefude
