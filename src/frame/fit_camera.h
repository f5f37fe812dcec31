#pragma once

#include <optional>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// A world point and where the picture shows it: x to the right, y down, in pixels.
struct SeenPoint {
  V3d world{0, 0, 0};
  double x = 0, y = 0;
};

/// The rotation and the place of the perspective camera that sees the points where they are seen:
/// the direct linear transform (Hartley and Zisserman, Multiple View Geometry, 2nd ed., 7.1),
/// its rotation by orthonormalising rows. The camera looks along its -z with y up. Nothing when the
/// points are fewer than 32, lie in one plane, or fit no such camera within half a pixel.
/// Cost: linear in the points, and the eigenvectors of a 12 x 12 matrix.
std::optional<Transform> fitCamera(const std::vector<SeenPoint>& points);

}  // namespace kagefude
