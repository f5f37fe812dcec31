#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passes/seen_surface.h"
#include "passes/shadow_wedges.h"
#include "passes/subpixel_points.h"

namespace kagefude {

/// A pixel that shows one flat surface: its four corners on it, in order, relative to the eye.
struct FlatPixel {
  std::array<V3f, 4> corners;
  uint32_t id = 0;
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

  /// Following calls of locate lie in the rectangle [x0, x1) x [y0, y1).
  void startTile(int x0, int y0, int x1, int y1);
  /// Looks at pixel (x, y), which must show a surface. True, with `flat` filled, when all of it is
  /// one plane.
  ///
  /// Points are lifted off their surface by `lift` world units, to the side that the camera sees:
  /// what keeps a surface out of its own shadow on the lit side, and in it on the other.
  bool locate(int x, int y, float lift, FlatPixel& flat);
  /// The sub-pixels of the pixel last located.
  void sample(SubpixelPoints& points);

 private:
  struct Ray {
    V3f origin, direction;
  };
  struct Rays;
  struct Hits;

  void gatherTile();
  void findCandidates();
  void judgeCentre(int candidate, float tolerance);
  bool coversPixel(int candidate) const;
  bool liesBehind(int candidate, const std::array<Ray, 4>& corners, float farthest) const;
  bool onOneTriangle(const std::array<Ray, 4>& corners, std::array<V3f, 4>& found) const;
  bool isHidden(int candidate) const;
  void findHits(const Rays& rays, Hits& hits) const;
  Ray ray(double x, double y) const;
  V3f onPlane(int x, int y, const Ray& ray) const;
  /// Lifted off the candidate's triangle.
  V3f lifted(const V3f& point, int candidate) const;
  /// The nearest neighbour on sub-pixel k's side that is no caster: background or another surface.
  /// False when all around are casters: the sub-pixel looks through a hole between them.
  bool beyondSilhouette(int k, int& column, int& row) const;
  bool seenAround(uint32_t id) const;
  /// Surface of a sub-pixel given what its ray met; false where it shows background.
  bool settle(int k, const Ray& ray, uint32_t hitId, const V3f& hit, V3f& point,
              uint32_t& id) const;

  const SeenSurface& surface_;
  const ShadowWedges& sight_;
  int x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  bool gathered_ = false;
  WedgeList tile_;
  std::vector<uint8_t> touching_;

  int x_ = 0, y_ = 0;
  float lift_ = 0;
  V3f centre_{0, 0, 0}, stepX_{0, 0, 0}, stepY_{0, 0, 0};  ///< what wedge sides are evaluated at
  bool explained_ = false;
  int own_ = -1;                 ///< the candidate under the pixel's centre
  std::vector<int> candidates_;  ///< indices into tile_
  std::vector<uint32_t> hidden_;
};

}  // namespace kagefude
