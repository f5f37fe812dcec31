#pragma once

#include <array>
#include <cstdint>

#include "passes/casters/seen_triangles.h"
#include "passes/casters/subpixel_points.h"

namespace kagefude {

/// A pixel that shows one flat surface: its four corners on it, in order, relative to the eye.
struct FlatPixel {
  std::array<V3f, 4> corners;
  uint32_t id = 0;
  bool facesAway = false;  ///< all of it is the side of a caster that the light does not reach
};

/// Finds the surface of each sub-pixel (004 2.2, where it is the displayed polygon). Casters that
/// are seen give it exactly: the triangle under the pixel's centre must agree with P, then every
/// sub-pixel takes its nearest triangle, so silhouettes and creases fall where they should; where
/// it meets none, the surface (or background) of the nearest neighbour that is no caster is seen.
/// Elsewhere the surface is the plane through P with normal N. Objects that lie before P at the
/// centre (unseen by the camera) are left out of that pixel. One sampler per thread.
class SurfaceSampler {
 public:
  /// `sight` holds the casters' wedges with the camera as the light; `light` is the light itself.
  SurfaceSampler(const SeenSurface& surface, const ShadowWedges& sight, const LightPlace& light)
      : surface_(surface), sight_(sight), seen_(surface, sight, light) {}

  /// Following calls of locate lie in the rectangle [x0, x1) x [y0, y1).
  void startTile(int x0, int y0, int x1, int y1) { seen_.startTile(x0, y0, x1, y1); }
  /// Looks at pixel (x, y), which must show a surface. True, with `flat` filled, when all of it is
  /// one plane.
  ///
  /// Points are lifted off their surface by `lift` world units, to the side that the camera sees:
  /// what keeps a surface out of its own shadow on the lit side.
  bool locate(int x, int y, float lift, FlatPixel& flat);
  /// The sub-pixels of the pixel last located.
  void sample(SubpixelPoints& points);

 private:
  bool onOneTriangle(const std::array<SightRay, 4>& corners, std::array<V3f, 4>& found) const;
  V3f onPlane(int x, int y, const SightRay& ray) const;
  /// Lifted off the candidate's triangle.
  V3f lifted(const V3f& point, int candidate) const;
  /// The nearest neighbour on sub-pixel k's side that is no caster: background or another surface.
  /// False when all around are casters: the sub-pixel looks through a hole between them.
  bool beyondSilhouette(int k, int& column, int& row) const;
  bool seenAround(uint32_t id) const;
  /// Whether a sub-pixel shows the triangle that its ray met, at `hit`, or the surface of pixel
  /// (column, row), at `plane`, or background.
  enum class Shown { triangle, pixel, background };
  Shown shown(int k, const SightRay& ray, uint32_t hitId, const V3f& hit, V3f& plane, int& column,
              int& row) const;

  const SeenSurface& surface_;
  const ShadowWedges& sight_;
  SeenTriangles seen_;
  int x_ = 0, y_ = 0;
  float lift_ = 0;
};

}  // namespace kagefude
