#pragma once

#include "passes/tone/surfaces.h"

namespace kagefude {

/// Way from a pixel to one of its neighbours.
struct NeighbourStep {
  int dx, dy;
};

/// Decides which neighbouring pixels belong to one surface, as surfaces.h defines it.
class SurfaceJoins {
 public:
  SurfaceJoins(View<const uint32_t> ids, Vec3View normal, Vec3View position,
               const SurfacesParams& params);

  /// joins[x] = 1 where pixel x of row y and its neighbour over `step` belong together, else 0; 0
  /// also where the neighbour lies outside the frame. step.dy is 0 or 1.
  void row(int y, NeighbourStep step, uint8_t* joins) const;

 private:
  bool joined(int x, int y, NeighbourStep s) const;
  bool normalsAgree(int x, int y, int qx, int qy) const;
  bool positionsAgree(int x, int y, NeighbourStep s) const;
  void lowerByStep(int x, int y, NeighbourStep s, float& spacing2) const;
  bool nearPlane(const V3f& d, const V3f& n, float spacing2) const;

  View<const uint32_t> ids_;
  Vec3View normal_, position_;
  float gap2_, cosine2_;
};

}  // namespace kagefude
