#pragma once

#include <cstdint>

#include "image/plane.h"
#include "passes/casters/camera_rays.h"

namespace kagefude {

/// What the frame knows of the surfaces in the picture: one sample at each pixel's centre, and the
/// camera's rays. Normals may be shading normals; they count only where no caster explains a pixel.
/// A pixel whose ID is 0 or whose position is not finite is background.
struct SeenSurface {
  Vec3View position;  ///< world space
  Vec3View normal;    ///< world space, unit
  View<const uint32_t> ids;
  CameraRays rays;

  bool isSurface(int x, int y) const;
  /// Position relative to the camera's eye.
  V3f relative(int x, int y) const { return V3f(V3d(position(x, y)) - rays.eye); }
  /// Width of pixel (x, y) in world units at its surface.
  float pixelSize(int x, int y) const;
  /// Throws InputError when the planes differ in size.
  void check() const;
};

}  // namespace kagefude
