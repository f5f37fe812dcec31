#pragma once

#include <cmath>

#include "passes/brush/brush_anchor.h"
#include "passes/brush/brush_angle.h"
#include "passes/brush/brush_repeat.h"
#include "passes/strip/strip.h"

// Where one pixel reads its strip: the brush pass's mathematics without its loops.
namespace kagefude {

/// Keeps the patterns of the object's three axes from showing the same strokes side by side.
inline constexpr float axisOffset[3] = {0.0f, 0.381966f, 0.763932f};
/// Share of the largest axis's squared part below which another axis is not read at all: two
/// patterns lie over each other within 7 degrees of the diagonal only.
inline constexpr float axisThreshold = 0.6f;
/// Added to the squared parts of a unit normal, so that an unknown one counts all planes alike.
inline constexpr float leastFacing = 1e-12f;
/// Distance from the light axis, in mapping distances, within which the three axes weigh alike.
inline constexpr float heldNearAxis = 0.05f;

/// Weight of one of several patterns by its part against the largest's.
inline float excessShare(float part, float largest) {
  const float excess = part / largest - axisThreshold;
  const float positive = excess > 0.0f ? excess : 0.0f;
  return positive * positive;
}

/// The same for object grain: wide, or strokes would lie in squares round the axis.
inline constexpr float objectNearAxis = 1.0f;

/// One pixel of the brush pass: position, normal (zero: unknown), tone, and their change to the
/// next pixel in x and y; and what held strokes go by: where it lies along the object's axes, how
/// that changes, and these axes' directions. Held strokes at rest have all of it along the object's
/// axes, as it rests.
struct BrushPixel {
  V3f position, normal;
  V3f dx{0, 0, 0}, dy{0, 0, 0};
  float tone = 0, toneDx = 0, toneDy = 0;
  float place[3] = {0, 0, 0}, placeDx[3] = {0, 0, 0}, placeDy[3] = {0, 0, 0};
  V3f axes[3];  ///< a direction's part along axis k is its product with axes[k]
  bool atRest = false;
  float along = 0;                  ///< place on the anchor's long side
  StrokeOctave octave{1, 0, 0, 0};  ///< of held strokes
};

/// The places on the strip that are mixed at one pixel, with their weights.
struct BrushTaps {
  static constexpr int most = 12;
  int count = 0;
  float u[most];
  float across[most];  ///< object grain: the place across the strokes, in heights of the grain
  float weight[most];
  Footprint footprint[most];
  float amplitude = 1;  ///< of the strokes against the row's mean

  void add(float place, float share, const Footprint& f) {
    u[count] = place;
    weight[count] = share;
    footprint[count++] = f;
  }
};

/// The reference points that hold at p: the first of two neighbours and the share of the second.
struct BrushPlace {
  size_t point = 0;
  float next = 0;
};

/// Place of a point of the world on the anchor's long side.
inline float placeAlong(const BrushAnchor& anchor, const V3f& p) {
  return anchor.longSide.dot(p - anchor.object.origin);
}

/// Parts of a direction of the world along an object's axes.
inline V3f alongAxes(const ObjectAxes& object, const V3f& d) {
  return {d.dot(object.x), d.dot(object.y), d.dot(object.z)};
}

/// What strokes run round: the axis from the light, and a point on it; over instances the same at
/// every `step` along each axis, `steps` to a unit (0 and 0: once).
struct StrokeCentre {
  V3f axis, position;
  float step = 0, steps = 0;
};

/// Part of a way from a centre that is left beyond its nearest repeat.
__attribute__((always_inline)) inline float fromNearest(float way, float step, float steps) {
  return way - step * std::floor(way * steps + 0.5f);
}

/// Of a reference point in the world; at rest along the object's axes, from its origin.
inline StrokeCentre strokeCentre(const BrushAnchor& anchor, const BrushAnchor::Point& point,
                                 bool atRest) {
  if (!atRest) return {point.frame.axis, point.position};
  const float step = anchor.instanceStep;
  return {alongAxes(anchor.object, point.frame.axis),
          alongAxes(anchor.object, point.position - anchor.object.origin), step,
          step > 0.0f ? 1.0f / step : 0.0f};
}

/// Smooth weights at a place on the anchor's long side, over `blend` of each gap between two
/// points.
BrushPlace brushPlace(const BrushAnchor& anchor, float along, float blend);

/// Places of the seed's two lookups (002 eq. 3.10) with the weights 1 - t and t (eq. 3.11).
void addSeedTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                 BrushTaps& taps);

/// The same rings with analytic footprints and a fade round the axis.
void addPolarTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                  BrushTaps& taps);

/// Places in the planes of the object's own axes: the plane that the surface faces, along whichever
/// of its two axes the strokes run. `aspect`: width over height of the grain in texels.
void addObjectTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                   float aspect, BrushTaps& taps);

/// Places along the object's own axes.
void addHeldTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                 BrushTaps& taps);

}  // namespace kagefude
