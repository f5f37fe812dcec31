#pragma once

#include <span>
#include <vector>

#include "passes/light_shape/light_mesh.h"

namespace kagefude {

/// Share of a triangle where the linear function with corner values a, b, c is positive. A corner
/// at 0 counts as dark; continuous everywhere else.
float positiveShare(float a, float b, float c);

/// Share of [0, 1] where the linear function from a to b is positive.
float positiveShare(float a, float b);

inline constexpr size_t mostMasks = 65;  ///< of one light

/// Share of the unit disc on the positive side of a line at signed distance d from its centre.
float discShare(float d);

/// Whether places are a disc's centre and then 4 or 8 on its rim, evenly in turning order.
bool placesOnRing(std::span<const V2f> places);

/// Whether places are of a rectangle: those at its four corners (±1, ±1) are among them.
bool placesOnRectangle(std::span<const V2f> places);

/// Turns signed distances at a light's masks into the share of the light with positive distance.
/// A disc's centre and ring are integrated over wedges; a rectangle's places over the triangles
/// between them, which cover it; places anywhere else likewise, grown to the disc's area. Places
/// that are all one, or on a line that is not v = 0, give the share of masks with positive
/// distance.
class LightShare {
 public:
  /// places: as lightShapeVisibility takes them. radius: of the light, in units of place; a
  /// rectangle's half sides.
  LightShare(std::span<const V2f> places, bool linear, float radius);

  /// s: one signed distance for each mask.
  float of(const float* s) const;

 private:
  float ofLine(const float* s) const;
  float ofPlane(const float* s) const;
  float rectangleShare(float mean, float u, float v) const;
  float ofWedges(const float* s) const;
  float ofMesh(const float* s) const;
  float meanOf(const float* s) const;
  void buildMesh();
  void fitPlane();

  std::vector<V2f> places_;
  bool line_, linear_, ring_, rectangle_;
  float radius_;
  float moment_;          ///< of the places about an axis of the disc
  std::vector<V3f> fit_;  ///< mean, u, v of the plane through any other places, by mask
  std::vector<LightMesh::Triangle> triangles_;  ///< of discs that are more than one ring
  std::vector<LightMesh::Blend> corners_;       ///< their corners on the light of `radius`
};

/// Whether places lie on a line (every v is 0).
bool placesOnLine(std::span<const V2f> places);

}  // namespace kagefude
