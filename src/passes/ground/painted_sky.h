#pragma once

#include "image/vec.h"
#include "passes/casters/camera_rays.h"
#include "passes/edges/coverage_blend.h"
#include "passes/ground/ground.h"
#include "passes/strip/strip.h"

namespace kagefude {

/// How a picture looks at what is behind things.
struct SkyView {
  int width = 0, height = 0;                ///< of the planes
  int offsetX = 0, offsetY = 0;             ///< of their first pixel, from the display's corner
  int displayWidth = 0, displayHeight = 0;  ///< pixels
  const CameraRays* rays = nullptr;         ///< null: not known
  bool upIsY = false;                       ///< world's up axis; else Z

  /// Whether directions of view differ from pixel to pixel.
  bool looksRound() const { return rays && !rays->orthographic; }
};

/// **[ours]** Row of the strip, as a tone 0..1, behind things: `low` at the picture's foot and
/// `high` at its head, in between linear; by the direction of view `low` at the horizon and below,
/// towards `high` at the zenith along 1 - (1 - e)² of the elevation e; or the brightness of
/// `behind` as the eye sees it, L^(1/2.2), clamped, L of Rec. 709. Without a view that looks round
/// `view` is as `height`; `behind` is read for `beauty` only.
Floats skyTone(const SkyView& view, const GroundParams& params, const Vec3View& behind);

/// **[ours]** Strokes of a strip on what is behind things, as strokes of object grain lie on a
/// plane: the grain lies on the screen, or on the directions of view, where a whole number of
/// widths goes into the turn, and each tone picks its colours. Strokes run level. Straight up and
/// down the directions run together, and strokes with them. Scene-linear, associated. Cost: one
/// lookup a pixel.
ColourPlanes paintSky(const Strip& strip, View<const float> tone, const SkyView& view,
                      const GroundParams& params);

}  // namespace kagefude
