#pragma once

#include <optional>
#include <vector>

#include "frame/sidecar.h"
#include "passes/tone/light.h"
#include "passes/tone/light_reach.h"

namespace kagefude {

/// How much one light shapes the tone of a frame. Irradiances are luminances in watts per square
/// metre that arrive at the light's subject on a surface that faces the light, as measured in
/// Cycles: a sun of strength S gives S, point and spot of P watts P/(4 pi d^2), an area light
/// P cos/(4 d^2) on its front side.
struct LightWeight {
  float subject = 1;  ///< irradiance at the subject, of the whole shot where the JSON says it
  float axis = 1;     ///< the same on an area light's axis; other lights: `subject`
  float lead = 1;     ///< the light with the largest leads the strokes
  float dimming = 1;  ///< power in this frame, of its largest over the shot
  LightPower power;   ///< of this frame, for irradiance anywhere
  bool known = true;  ///< false: of a light that only the look describes, without a weight
};

/// The weight of a light that the JSON describes. `placed` is the light where it stands, `moved`
/// says that this is not where the JSON has it; then its weight is that of its new place. `asked`
/// is the look's own weight, below 0: none. Without a `shot`, or with a light that the shot does
/// not name, the frame's own power and place count. A light at the subject counts as 1e-6 away.
LightWeight weighLight(const SidecarLight& source, const WholeShot* shot, const Light& placed,
                       bool moved, float asked);

/// The weight of a light that only the look describes; below 0: not known, see weighUnknown.
LightWeight weighOwnLight(float asked);

/// Gives each light whose weight is not known the mean of those that are, else 1.
void weighUnknown(const std::vector<LightWeight*>& weights);

}  // namespace kagefude
