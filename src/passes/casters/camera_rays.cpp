#include "passes/casters/camera_rays.h"

#include <cmath>

#include "base/error.h"

namespace kagefude {
namespace {

/// Corners of a plane at one clip-space depth, and its steps per pixel.
struct ScreenPlane {
  V3d corner, stepX, stepY;
};

ScreenPlane screenPlane(const Transform& worldFromClip, double depth, const V3d& eye,
                        const V2f& display, const Window& data) {
  const auto at = [&](double x, double y) {
    return worldFromClip.point({2.0 * x / display.x - 1.0, 1.0 - 2.0 * y / display.y, depth}) - eye;
  };
  const V3d topLeft = at(0, 0);
  const V3d stepX = (at(display.x, 0) - topLeft) / display.x;
  const V3d stepY = (at(0, display.y) - topLeft) / display.y;
  return {topLeft + stepX * data.x + stepY * data.y, stepX, stepY};
}

bool finite(const V3d& v) { return std::isfinite(v.x + v.y + v.z); }

}  // namespace

CameraRays cameraRays(const Transform& clipFromCamera, const Transform& cameraFromWorld,
                      const V3d& eye, bool orthographic, const V2f& display, const Window& data) {
  const Transform worldFromClip = cameraFromWorld.inverse() * clipFromCamera.inverse();
  const ScreenPlane near = screenPlane(worldFromClip, -1, eye, display, data);
  const ScreenPlane far = screenPlane(worldFromClip, 1, eye, display, data);
  CameraRays rays;
  rays.eye = eye;
  rays.orthographic = orthographic;
  if (orthographic) {
    rays.origin0 = near.corner;
    rays.originX = near.stepX;
    rays.originY = near.stepY;
    rays.direction0 = (far.corner - near.corner).normalized();
  } else {
    const V3d middle =
        far.corner + far.stepX * (display.x / 2 - data.x) + far.stepY * (display.y / 2 - data.y);
    const double scale = 1 / middle.length();
    rays.direction0 = far.corner * scale;
    rays.directionX = far.stepX * scale;
    rays.directionY = far.stepY * scale;
  }
  const bool usable = finite(rays.direction0) && rays.direction0.length2() > 0 &&
                      finite(rays.originX) && finite(rays.originY) && finite(rays.origin0) &&
                      finite(rays.directionX) && finite(rays.directionY);
  if (!usable)
    throw InputError(
        "camera: clip_from_camera or camera_from_world has no inverse, so no rays can "
        "be drawn through the pixels");
  return rays;
}

}  // namespace kagefude
