#pragma once

#include <cstdint>
#include <vector>

#include "image/plane.h"
#include "passes/camera_rays.h"
#include "passes/shadow_wedges.h"

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

/// The surface at the 8x8 sub-pixels of one pixel, row by row; sub-pixel (i, j) has its place at
/// ((i + 0.5)/8, (j + 0.5)/8). Coordinates are relative to the camera's eye.
struct SubpixelPoints {
  alignas(64) float x[64];
  alignas(64) float y[64];
  alignas(64) float z[64];
  uint32_t id[64];
  uint64_t present = 0;  ///< sub-pixels that show a surface

  /// Box round the present points.
  PointBox box() const;
};

/// Finds the surface of each sub-pixel (004 2.2, where it is the displayed polygon). Casters that
/// are seen give it exactly: the triangle under the pixel's centre must agree with P, then every
/// sub-pixel takes its nearest triangle, so silhouettes and creases fall where they should; where
/// it meets none, the surface (or background) of the nearest neighbour that is no caster is seen.
/// Elsewhere the surface is the plane through P with normal N. Objects that lie before P at the
/// centre (unseen by the camera) are left out of that pixel. One sampler per thread.
class SurfaceSampler {
 public:
  /// `sight` holds the casters' wedges with the camera as the light.
  SurfaceSampler(const SeenSurface& surface, const ShadowWedges& sight)
      : surface_(surface), sight_(sight) {}

  /// Following calls of sample lie in the rectangle [x0, x1) x [y0, y1).
  void startTile(int x0, int y0, int x1, int y1);
  void sample(int x, int y, SubpixelPoints& points);

 private:
  struct Rays;
  struct Hits;

  bool explain(int x, int y, const Rays& rays);
  void findHits(const Rays& rays, Hits& hits) const;
  V3f onPlane(int x, int y, const Rays& rays, int k) const;
  /// The nearest neighbour on sub-pixel k's side that is no caster: background or another surface.
  bool beyondSilhouette(int x, int y, int k, int& column, int& row) const;
  bool seenAround(int x, int y, uint32_t id) const;

  const SeenSurface& surface_;
  const ShadowWedges& sight_;
  int x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  bool gathered_ = false;
  WedgeList tile_, pixel_;
  std::vector<uint32_t> hidden_;
};

}  // namespace kagefude
