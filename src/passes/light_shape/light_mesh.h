#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// Triangles between the places of a light's masks, to interpolate over the light.
class LightMesh {
 public:
  /// Delaunay triangulation; places that lie on one line give no triangle. Cost: the fourth power
  /// of the places, of which there are at most 64 or so.
  explicit LightMesh(std::span<const V2f> places);

  struct Triangle {
    uint32_t corner[3];
    float area;
  };
  std::span<const Triangle> triangles() const { return triangles_; }
  float area() const { return area_; }

  /// A place as a weighted mean of three masks' places: those of its triangle, or of the nearest
  /// one, beyond which it is carried on straight. Weights add up to 1.
  struct Blend {
    uint32_t mask[3];
    float weight[3];
  };
  Blend blendAt(const V2f& place) const;

 private:
  Blend blendIn(const Triangle& triangle, const V2f& place) const;

  std::vector<V2f> places_;
  std::vector<Triangle> triangles_;
  float area_ = 0;
};

}  // namespace kagefude
