#pragma once

#include "image/vec.h"
#include "image/window.h"

namespace kagefude {

/// The camera's rays: origin and direction are linear in the pixel's place, which is what makes
/// the trace of a plane in the picture a straight line. Coordinates are relative to `eye`, so that
/// single floats suffice far from the world's origin. (x, y) counts pixels from the top-left corner
/// of the data window; the pixel (i, j) has its centre at (i + 0.5, j + 0.5).
struct CameraRays {
  V3d eye{0, 0, 0};  ///< world place that all other coordinates are relative to
  V3d origin0{0, 0, 0}, originX{0, 0, 0}, originY{0, 0, 0};  ///< zero for a perspective camera
  /// Steps are zero for an orthographic camera.
  V3d direction0{0, 0, 0}, directionX{0, 0, 0}, directionY{0, 0, 0};
  bool orthographic = false;

  V3d origin(double x, double y) const { return origin0 + originX * x + originY * y; }
  V3d direction(double x, double y) const { return direction0 + directionX * x + directionY * y; }
  /// Width of a pixel in world units, for a surface that faces the camera at ray parameter t.
  double pixelSize(double t) const {
    return orthographic ? originX.length() : directionX.length() * t;
  }
};

/// Rays of the camera whose matrices are given, as the frame's JSON holds them. `display` is the
/// resolution that clip space spans, `data` the window that the planes hold (its origin counted
/// from the display's top-left corner). `eye` is the camera's position. Directions have length 1 in
/// the middle of the display. Throws InputError when the matrices have no inverse.
CameraRays cameraRays(const Transform& clipFromCamera, const Transform& cameraFromWorld,
                      const V3d& eye, bool orthographic, const V2f& display, const Window& data);

}  // namespace kagefude
