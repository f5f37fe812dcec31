#include "passes/casters/subpixel_rays.h"

#include <algorithm>

#include "image/clones.h"

namespace kagefude {
namespace {

KAGEFUDE_CLONES void meetTriangle(const float* c, const float* qx, const float* qy, const float* qz,
                                  const float* ox, const float* oy, const float* oz,
                                  const float* dx, const float* dy, const float* dz, int triangle,
                                  float* t, int* index) {
  for (int i = 0; i < 64; ++i) {
    const float s0 = c[0] * qx[i] + c[1] * qy[i] + c[2] * qz[i] - c[3];
    const float s1 = c[4] * qx[i] + c[5] * qy[i] + c[6] * qz[i] - c[7];
    const float s2 = c[8] * qx[i] + c[9] * qy[i] + c[10] * qz[i] - c[11];
    const float distance = c[15] - (c[12] * ox[i] + c[13] * oy[i] + c[14] * oz[i]);
    const float speed = c[12] * dx[i] + c[13] * dy[i] + c[14] * dz[i];
    const float at = speed > 0.0f ? distance / speed : farAway;
    const bool hit = (s0 >= 0.0f) & (s1 >= 0.0f) & (s2 >= 0.0f) & (at > 0.0f) & (at < t[i]);
    t[i] = hit ? at : t[i];
    index[i] = hit ? triangle : index[i];
  }
}

/// base + x step + y step at the sub-pixels, x and y from -1/2 to 1/2.
KAGEFUDE_CLONES void spread(float base, float stepX, float stepY, float* values) {
  for (int k = 0; k < 64; ++k) {
    const float x = (static_cast<float>(k % 8) - 3.5f) * 0.125f;
    const float y = (static_cast<float>(k / 8) - 3.5f) * 0.125f;
    values[k] = base + (stepX * x + stepY * y);
  }
}

}  // namespace

SubpixelRays::SubpixelRays(const CameraRays& camera, int column, int row) {
  const V3d origin = camera.origin(column + 0.5, row + 0.5);
  const V3d direction = camera.direction(column + 0.5, row + 0.5);
  const auto single = [](double value) { return static_cast<float>(value); };
  for (int i = 0; i < 3; ++i) {
    spread(single(origin[i]), single(camera.originX[i]), single(camera.originY[i]), o[i]);
    spread(single(direction[i]), single(camera.directionX[i]), single(camera.directionY[i]), d[i]);
  }
}

SubpixelHits::SubpixelHits() {
  std::fill_n(t, 64, farAway);
  std::fill_n(index, 64, -1);
}

void SubpixelHits::meet(const SubpixelRays& rays, bool orthographic,
                        const std::array<float, wedgeCoefficients>& wedge, int number) {
  const auto& q = orthographic ? rays.o : rays.d;
  meetTriangle(wedge.data(), q[0], q[1], q[2], rays.o[0], rays.o[1], rays.o[2], rays.d[0],
               rays.d[1], rays.d[2], number, t, index);
}

}  // namespace kagefude
