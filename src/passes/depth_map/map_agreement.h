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

  /// The map hides less than 0.4 of what the masks hide, or shows less than 0.95 of what they show.
  /// Of fewer than 64 pixels of either kind nothing is known.
  bool contradicts() const;
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
