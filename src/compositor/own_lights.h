#pragma once

#include <vector>

#include "compositor/frame_tone.h"
#include "compositor/styled_surfaces.h"
#include "passes/brush/brush_map.h"

namespace kagefude {

// **[ours]** Lights with strips of their own, in 004's sum I = I0 + Sum I_i (1 - k c_i). With a
// style's strip S, strips S_i of the lights that have one, tones c and shares w of all light:
//   I = S(t) + Sum_i w_i (S_i(c_i) - S_i(0)),  t = the tone of the other lights alone,
// so S(0) is the ambient light I0, and a light adds what its strip has beyond its own darkest row.
// Strips that are all one, and whose colour rises evenly with the tone, give what that strip gives
// of all lights together.

/// Whether any light of the frame has a strip of its own anywhere.
bool paintsOwnLights(const Look& look, const FramePlan& plan);

/// Throws LookError when style.light_strips names a light that the frame does not have. One that is
/// switched off is there.
void checkLightStrips(const Look& look, const FramePlan& plan);

/// Gathers StyledSurfaces::ownLights.
class OwnLights {
 public:
  OwnLights(const Look& look, const StripSet& strips, const FramePlan& plan);

  /// The next surface, whose strokes without a strip of the light's own are `own`.
  void add(const StyleParams& style, const BrushSubject& subject, const BrushAnchor& own,
           const BrushParams& brush);
  /// Those that paint any surface.
  std::vector<OwnLight> take();

 private:
  const Look& look_;
  const StripSet& strips_;
  const FramePlan& plan_;
  std::vector<OwnLight> lights_;
};

/// The tone of the lights that count in each surface's own strip, as sumTones. `tones` are those of
/// all lights, in the order of the plan's.
Floats sharedTone(const Look& look, const FramePlan& plan, const StyledSurfaces& styled,
                  const std::vector<View<const float>>& tones);

/// What the lights with strips of their own add: associated colour and alpha, below 0 where a
/// strip is darker than its darkest row. `surfaces` as paintStyles has them. Cost: two brushes over
/// the picture for each such light.
BrushResult paintOwnLights(const Look& look, const StripSet& strips, const FramePlan& plan,
                           const FramePlanes& planes, const StyledSurfaces& styled,
                           View<const uint32_t> surfaces,
                           const std::vector<View<const float>>& tones);

/// Adds it to the strokes; colour not below 0, alpha within 0..1. Nothing where it is empty.
void addOwnLights(const BrushResult& added, BrushResult& brush);

}  // namespace kagefude
