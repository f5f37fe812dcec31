#include "passes/brush/brush_taps.h"

#include <algorithm>

namespace kagefude {
namespace {

float smoothStep(float t) {
  const float c = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  return c * c * (3.0f - 2.0f * c);
}

// One reference point's strokes at one mapping distance.
void addRing(const BrushAnchor::Point& point, float mappingDistance, float shift, float share,
             const BrushPixel& pixel, const BrushParams& params, BrushTaps& taps) {
  const V3f q = pixel.position - point.position;
  const float a = point.frame.l1.dot(q), b = point.frame.l2.dot(q);
  const float squared = a * a + b * b;
  const float angle = turnsOf(a, b);
  // d atan2(a, b) = (b da - a db) / (a² + b²): no wrap in it.
  const float scale = squared > 0.0f ? 1.0f / (2.0f * pi * squared) : 0.0f;
  const auto turnsAlong = [&](const V3f& d) {
    return (b * point.frame.l1.dot(d) - a * point.frame.l2.dot(d)) * scale;
  };
  const float alongX = turnsAlong(pixel.dx), alongY = turnsAlong(pixel.dy);
  const BrushRepeat repeat = brushRepeat(std::sqrt(squared), mappingDistance, params.blendWidth);
  const auto add = [&](float count, float weight) {
    if (weight > 0.0f)
      taps.add(angle * count + shift, weight * share,
               {alongX * count, pixel.toneDx, alongY * count, pixel.toneDy});
  };
  // The innermost ring draws ring 1's strokes, so nothing is mixed at its edge.
  if (repeat.count < 1.0f) return add(1.0f, 1.0f);
  add(repeat.count, 1.0f - repeat.next);
  add(repeat.count + 1.0f, repeat.next);
}

// Part of the direction round the axis that lies in the surface.
V3f strokeDirection(const StrokeCentre& centre, const BrushPixel& pixel) {
  V3f way = pixel.position - centre.position;
  if (pixel.atRest)
    for (int k = 0; k < 3; ++k) way[k] = fromNearest(way[k], centre.step, centre.steps);
  const V3f round = centre.axis.cross(way);
  return round - pixel.normal * pixel.normal.dot(round);
}

// Squared parts of the strokes' direction along the object's axes.
void strokeParts(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                 float nearAxis, float* parts) {
  const BrushPlace place = brushPlace(anchor, pixel.along, params.pointBlend);
  const V3f* const axes = pixel.axes;
  const float near = nearAxis * anchor.mappingDistance * (1.0f + anchor.coarser);
  for (int k = 0; k < 3; ++k) parts[k] = near * near;
  for (int i = 0; i < 2; ++i) {
    const float share = i == 0 ? 1.0f - place.next : place.next;
    if (!(share > 0.0f)) continue;
    const BrushAnchor::Point& point = anchor.points[place.point + static_cast<size_t>(i)];
    const V3f along = strokeDirection(strokeCentre(anchor, point, pixel.atRest), pixel);
    for (int k = 0; k < 3; ++k) parts[k] += share * along.dot(axes[k]) * along.dot(axes[k]);
  }
}

}  // namespace

BrushPlace brushPlace(const BrushAnchor& anchor, float along, float blend) {
  BrushPlace place;
  const size_t last = anchor.points.size() - 1;
  if (last == 0) return place;
  while (place.point < last && along >= anchor.points[place.point + 1].along) ++place.point;
  if (place.point == last) return place;
  const float from = anchor.points[place.point].along, to = anchor.points[place.point + 1].along;
  if (!(along > from) || !(to > from)) return place;
  place.next = smoothStep(((along - from) / (to - from) - 0.5f) / blend + 0.5f);
  return place;
}

void addSeedTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                 BrushTaps& taps) {
  const BrushAnchor::Point& point = anchor.points[brushPlace(anchor, pixel.along, 1.0f).point];
  const float angle = brushAngle(point.frame, point.position, pixel.position);
  const BrushRepeat repeat = brushRepeat(axisDistance(point.frame, point.position, pixel.position),
                                         anchor.mappingDistance, params.blendWidth);
  taps.add(angle * repeat.count, 1.0f - repeat.next, {});
  taps.add(angle * (repeat.count + 1.0f), repeat.next, {});
}

void addPolarTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                  BrushTaps& taps) {
  const BrushPlace place = brushPlace(anchor, pixel.along, params.pointBlend);
  float distance = 0;
  for (int i = 0; i < 2; ++i) {
    const float share = i == 0 ? 1.0f - place.next : place.next;
    if (!(share > 0.0f)) continue;
    const BrushAnchor::Point& point = anchor.points[place.point + static_cast<size_t>(i)];
    distance += share * axisDistance(point.frame, point.position, pixel.position);
    if (anchor.coarser < 1.0f)
      addRing(point, anchor.mappingDistance, anchor.shift, share * (1.0f - anchor.coarser), pixel,
              params, taps);
    if (anchor.coarser > 0.0f)
      addRing(point, 2.0f * anchor.mappingDistance, anchor.coarserShift, share * anchor.coarser,
              pixel, params, taps);
  }
  if (params.poleFade > 0.0f)
    taps.amplitude =
        smoothStep(distance / (params.poleFade * anchor.mappingDistance * (1.0f + anchor.coarser)));
}

void addObjectTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                   float aspect, BrushTaps& taps) {
  const V3f* const axes = pixel.axes;
  float parts[3];
  strokeParts(anchor, pixel, params, objectNearAxis, parts);
  const bool known = pixel.normal.dot(pixel.normal) > 0.0f;
  const V3f normal = known ? pixel.normal : pixel.dx.cross(pixel.dy);
  float facing[3];
  for (int k = 0; k < 3; ++k) facing[k] = normal.dot(axes[k]) * normal.dot(axes[k]) + leastFacing;
  const float mostFacing = std::max(std::max(facing[0], facing[1]), facing[2]);
  const StrokeOctave& octave = pixel.octave;
  const float perUnit = 1.0f / (2.0f * pi * octave.mappingDistance);
  const float *const place = pixel.place, *const placeDx = pixel.placeDx,
                     *const placeDy = pixel.placeDy;
  for (int k = 0; k < 3; ++k) {
    const float faces = excessShare(facing[k], mostFacing);
    if (!(faces > 0.0f)) continue;
    const int axis[2] = {(k + 1) % 3, (k + 2) % 3};
    const float largest = std::max(parts[axis[0]], parts[axis[1]]);
    const float first = excessShare(parts[axis[0]], largest),
                second = excessShare(parts[axis[1]], largest);
    const float share[2] = {first / (first + second), second / (first + second)};
    for (int side = 0; side < 2; ++side) {
      if (!(share[side] > 0.0f)) continue;
      const int i = axis[side], j = axis[1 - side];
      const auto add = [&](float unit, float shift, float part) {
        if (!(part > 0.0f)) return;
        const float down = unit * aspect;
        taps.across[taps.count] = place[j] * down + axisOffset[k];
        taps.add(place[i] * unit + (axisOffset[i] + shift), faces * share[side] * part,
                 {placeDx[i] * unit, placeDx[j] * down, placeDy[i] * unit, placeDy[j] * down});
      };
      add(perUnit, octave.shift, 1.0f - octave.coarser);
      add(0.5f * perUnit, octave.coarserShift, octave.coarser);
    }
  }
}

void addHeldTaps(const BrushAnchor& anchor, const BrushPixel& pixel, const BrushParams& params,
                 BrushTaps& taps) {
  float parts[3];
  strokeParts(anchor, pixel, params, heldNearAxis, parts);
  const float largest = std::max(std::max(parts[0], parts[1]), parts[2]);
  const StrokeOctave& octave = pixel.octave;
  const float perUnit = 1.0f / (2.0f * pi * octave.mappingDistance);
  for (int k = 0; k < 3; ++k) {
    const float weight = excessShare(parts[k], largest);
    if (!(weight > 0.0f)) continue;
    const auto add = [&](float unit, float offset, float share) {
      if (share > 0.0f)
        taps.add(pixel.place[k] * unit + offset, weight * share,
                 {pixel.placeDx[k] * unit, pixel.toneDx, pixel.placeDy[k] * unit, pixel.toneDy});
    };
    add(perUnit, axisOffset[k] + octave.shift, 1.0f - octave.coarser);
    add(0.5f * perUnit, axisOffset[k] + octave.coarserShift, octave.coarser);
  }
}

}  // namespace kagefude
