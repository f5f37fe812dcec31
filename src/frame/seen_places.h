#pragma once

#include <vector>

#include "exr/image_file.h"
#include "frame/fit_camera.h"
#include "image/vec.h"

namespace kagefude {

/// A pixel of a smooth piece of surface: its normal as the pass has it, and the one that the
/// neighbouring positions span, turned towards the viewer; unit.
struct SmoothPlace {
  V3f given{0, 0, 0};
  V3f spanned{0, 0, 0};
  int x = 0, y = 0;
};

/// Some 4,000 pixels, evenly over the frame, that see something (a position other than 0) and where
/// the picture shows it, in square pixels.
std::vector<SeenPoint> seenPoints(const ImageFile& file, Vec3View position);

/// Of as many pixels those whose neighbours left, right, above and below belong to the same thing
/// and lie evenly, so that the positions span a plane there. World space or the camera's, as the
/// positions are, if that space is right-handed.
std::vector<SmoothPlace> smoothPlaces(Vec3View position, Vec3View normal, View<const uint32_t> ids);

}  // namespace kagefude
