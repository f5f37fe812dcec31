#pragma once

#include <span>

#include "passes/light_shape/light_share.h"
#include "passes/light_shape/mask_distance.h"
#include "passes/light_shape/shadow_taps.h"

namespace kagefude {

/// Where distances do not explain what masks show, so that shadows must be followed.
class ShadowNeed {
 public:
  /// distances: of the masks, at `edges`, the pixels where masks disagree. All must outlive this.
  ShadowNeed(const ShadowTaps& taps, const Distances& distances, const PixelSet& edges,
             std::span<const V2f> places)
      : taps_(taps),
        distances_(distances),
        edges_(edges),
        places_(places),
        rectangle_(placesOnRectangle(places)) {}

  /// 0 where one straight edge, moved over the light, explains all distances of a pixel where masks
  /// disagree; 1 where it is far from doing so, and where masks agree and a shadow thinner than its
  /// shift may have been missed by all of them.
  float at(int x, int y) const;

 private:
  /// Whether a pixel of the same label near (x, y) shows `opposite`.
  bool besideOpposite(int x, int y, ShadowTaps::Seen opposite) const;

  const ShadowTaps& taps_;
  const Distances& distances_;
  const PixelSet& edges_;
  std::span<const V2f> places_;
  bool rectangle_;
};

}  // namespace kagefude
