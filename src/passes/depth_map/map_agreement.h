#pragma once

#include <cstddef>
#include <span>

#include "passes/depth_map/shadow_map.h"
#include "passes/tone/light.h"

namespace kagefude {

/// Pixels that all of a light's masks call hidden or all call lit, and how many of them its depth
/// map calls the same.
struct MapAgreement {
  size_t hidden = 0, hiddenInMap = 0;
  size_t lit = 0, litInMap = 0;
  size_t litInside = 0;   ///< lit ones that lie within the map
  size_t litOwn = 0;      ///< of these, those that are in the map themselves
  size_t partly = 0;      ///< pixels of which the masks differ
  bool mapEmpty = false;  ///< no texel of the map holds anything

  /// The map hides less than 0.4 of what the masks hide, or shows less than 0.95 of what they show,
  /// or is empty although they hide something, wholly or in part. Where they hide too little to
  /// tell, it also contradicts if it has less than 0.02 of the lit places within it: other maps see
  /// past them. (That alone is no fault, for what casts no shadow may be left out of a map.) Each
  /// kind speaks for itself; fewer than 64 pixels of it say nothing.
  bool contradicts() const;
  bool emptyThoughHidden() const;
  bool seesPastLit() const;
};

/// Counts over some 4,000 places at even distances on the frame. Only places that face the light
/// by a cosine of 0.2 count, for masks at grazing light tell of the surface's own horizon. Hidden
/// in the map: its texel is nearer to the light than the place by more than four texel widths on
/// the surface. position, normal: world. labels: 0 = background. masks: 0 = hidden. A map whose
/// matrices send places nowhere calls all lit. Throws InputError when sizes differ or the map is
/// empty. Cost: about a millisecond.
MapAgreement agreementOf(std::span<const View<const uint8_t>> masks, const Light& light,
                         Vec3View position, Vec3View normal, View<const uint32_t> labels,
                         const ShadowMap& map);

}  // namespace kagefude
