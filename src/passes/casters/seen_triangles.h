#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passes/casters/seen_surface.h"
#include "passes/casters/shadow_wedges.h"
#include "passes/casters/subpixel_rays.h"

namespace kagefude {

/// The casters' triangles that one pixel may show, and which of them lies under its centre. Found
/// tile by tile. One for each thread.
class SeenTriangles {
 public:
  /// `sight` holds the casters' wedges with the camera as the light.
  SeenTriangles(const SeenSurface& surface, const ShadowWedges& sight, const LightPlace& light)
      : surface_(surface), sight_(sight), light_(light) {}

  /// Following calls of find lie in the rectangle [x0, x1) x [y0, y1).
  void startTile(int x0, int y0, int x1, int y1);
  /// Finds what pixel (x, y), which must show a surface, may show.
  void find(int x, int y);

  /// Triangles of the pixel last found, to be asked for below. Those of objects that lie before P
  /// at the centre (unseen by the camera) are left out.
  const std::vector<int>& candidates() const { return candidates_; }
  /// The candidate under the pixel's centre that agrees with P; -1 when there is none.
  int own() const { return own_; }

  uint32_t id(int candidate) const { return tile_.id[candidate]; }
  std::array<float, wedgeCoefficients> wedge(int candidate) const { return tile_.wedge(candidate); }
  /// Unit normal, away from the eye.
  V3f normal(int candidate) const;
  /// The ray's parameter where it meets the candidate's plane.
  float distance(int candidate, const SightRay& ray) const;
  /// Whether every ray of the pixel passes through the candidate.
  bool coversPixel(int candidate) const;
  /// Whether all corner rays meet the candidate's plane beyond `farthest`.
  bool liesBehind(int candidate, const std::array<SightRay, 4>& corners, float farthest) const;
  /// Whether the light falls on the side that the camera does not see, by more than rounding:
  /// then what is seen of the candidate lies in the candidate's own shadow.
  bool facesAway(int candidate) const;

  SightRay ray(double x, double y) const;

 private:
  void gatherTile();
  void findTouching();
  void judgeCentre(int candidate, float tolerance);
  bool isUnseen(int candidate) const;

  const SeenSurface& surface_;
  const ShadowWedges& sight_;
  const LightPlace& light_;
  int x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  bool gathered_ = false;
  WedgeList tile_;
  std::vector<uint8_t> touching_;

  int x_ = 0, y_ = 0;
  V3f centre_{0, 0, 0}, stepX_{0, 0, 0}, stepY_{0, 0, 0};  ///< what wedge sides are evaluated at
  int own_ = -1;
  std::vector<int> candidates_;  ///< indices into tile_
  std::vector<int> before_;      ///< candidates that lie before P at the centre
};

}  // namespace kagefude
