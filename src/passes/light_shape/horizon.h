#pragma once

#include <span>

#include "passes/light_shape/light_shape.h"

namespace kagefude {

/// The light over a receiver's own horizon: what masks see of it there is linear over the light,
/// and known without distances.
class Horizon {
 public:
  /// All must outlive this. places: of the masks.
  Horizon(const LightGeometry& geometry, std::span<const V2f> places, Vec3View position,
          Vec3View normal)
      : geometry_(geometry), places_(places), position_(position), normal_(normal) {}

  /// Heights of the masks' places; false when anything else decides what the masks see.
  bool explains(std::span<const View<const uint8_t>> masks, int x, int y, float* height) const;

 private:
  const LightGeometry& geometry_;
  std::span<const V2f> places_;
  Vec3View position_, normal_;
};

/// A round light with one hard mask at `towardsFar` from its centre and one as far on the other
/// side, along the axis to the subject.
struct PairLight {
  V3f position{0, 0, 0};    ///< world
  V3f towardsFar{0, 0, 0};  ///< world
  float radius = 0;         ///< world units; 0: hard
};

/// Where a pair of masks disagrees because one of them stands below the receiver's horizon and the
/// other above, sets the visibility to the share of the light's disc that stands above: no search
/// can tell, since such a face often has no umbra and no lit pixel, or only far ones.
void settleAtHorizon(View<const uint8_t> farMask, View<const uint8_t> nearMask,
                     View<const uint32_t> labels, Vec3View position, Vec3View normal,
                     const PairLight& light, View<float> visibility);

}  // namespace kagefude
