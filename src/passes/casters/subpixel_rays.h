#pragma once

#include <array>

#include "passes/casters/camera_rays.h"
#include "passes/casters/wedge_list.h"

namespace kagefude {

/// A ray of sight, relative to the camera's eye.
struct SightRay {
  V3f origin, direction;
};

/// Farther than any surface.
inline constexpr float farAway = 3e38f;

/// The rays through the 8x8 sub-pixels of one pixel, in the order of SubpixelPoints.
struct SubpixelRays {
  alignas(64) float o[3][64];
  alignas(64) float d[3][64];

  SubpixelRays(const CameraRays& camera, int column, int row);
  SightRay operator[](int k) const {
    return {{o[0][k], o[1][k], o[2][k]}, {d[0][k], d[1][k], d[2][k]}};
  }
};

/// Where each ray first meets a triangle: the ray's parameter, farAway for none, and the number
/// the triangle was given, -1 for none.
struct SubpixelHits {
  alignas(64) float t[64];
  alignas(64) int index[64];

  SubpixelHits();
  /// Takes the triangle where a ray passes its sides and meets it before the best so far.
  /// `wedge` has the camera as its light.
  void meet(const SubpixelRays& rays, bool orthographic,
            const std::array<float, wedgeCoefficients>& wedge, int number);
};

}  // namespace kagefude
