#include "passes/brush/brush_pixel.h"

#include <algorithm>
#include <cmath>

#include "passes/brush/brush_taps.h"
#include "passes/brush/grain_lookup.h"
#include "passes/brush/rest_axes.h"

namespace kagefude {
namespace {

struct Change {
  V3f position{0, 0, 0}, rest{0, 0, 0};
  float tone = 0;
};

// Change to the next pixel along one direction, from the neighbour behind or before that belongs
// to the same anchor and differs less; position (and with it the place at rest) and tone choose for
// themselves. The tone's is 0 unless it rises or falls on both sides: at borders, and on things a
// pixel or two wide, the step to the only neighbour is no slope of the pixel, which would be
// painted with what lies next to it.
Change changeAlong(const BrushInput& in, bool atRest, int x, int y, int stepX, int stepY,
                   const V3f& p, float tone) {
  Change best;
  float smallest = noChange, tones[2] = {0, 0};
  for (int side = 1; side >= -1; side -= 2) {
    const int nx = x + side * stepX, ny = y + side * stepY;
    if (!in.index.contains(nx, ny) || in.index(nx, ny) != in.index(x, y)) continue;
    const V3f neighbour = in.position(nx, ny);
    if (!isFinite(neighbour)) continue;
    const V3f d = (neighbour - p) * static_cast<float>(side);
    if (d.dot(d) < smallest) {
      smallest = d.dot(d);
      best.position = d;
      if (atRest) best.rest = (in.rest(nx, ny) - in.rest(x, y)) * static_cast<float>(side);
    }
    tones[side > 0] = (clampedUnit(in.tone(nx, ny)) - tone) * static_cast<float>(side);
  }
  if (tones[0] * tones[1] > 0.0f)
    best.tone = std::fabs(tones[0]) < std::fabs(tones[1]) ? tones[0] : tones[1];
  return best;
}

// Places along the object's axes, of positions.
void placeInObject(const BrushAnchor& anchor, BrushPixel& pixel) {
  const V3f axes[3] = {anchor.object.x, anchor.object.y, anchor.object.z};
  const V3f q = pixel.position - anchor.object.origin;
  for (int k = 0; k < 3; ++k) {
    pixel.axes[k] = axes[k];
    pixel.place[k] = axes[k].dot(q);
    pixel.placeDx[k] = axes[k].dot(pixel.dx);
    pixel.placeDy[k] = axes[k].dot(pixel.dy);
  }
  pixel.along = placeAlong(anchor, pixel.position);
}

// From here on position, normal and changes are along the object's axes.
void moveAlongAxes(const V3f& place, const V3f& dx, const V3f& dy, BrushPixel& pixel) {
  V3f normal;
  for (int k = 0; k < 3; ++k) {
    normal[k] = pixel.normal.dot(pixel.axes[k]);
    pixel.axes[k] = V3f(k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f);
  }
  const float length = std::sqrt(normal.dot(normal));
  pixel.normal = length > 0.0f ? normal / length : V3f(0.0f);
  pixel.position = place;
  pixel.dx = dx;
  pixel.dy = dy;
  pixel.atRest = true;
}

// The same of places at rest. Where the map to rest is not known the object's axes stand.
void placeAtRest(const BrushAnchor& anchor, const V3f& place, const V3f& dx, const V3f& dy,
                 bool keepsSize, BrushPixel& pixel) {
  const V3f& a = pixel.dx;
  const V3f& b = pixel.dy;
  const RestChange change{a.x, a.y, a.z, b.x, b.y, b.z, {dx.x, dx.y, dx.z}, {dy.x, dy.y, dy.z}};
  float x[3] = {anchor.object.x.x, anchor.object.y.x, anchor.object.z.x};
  float y[3] = {anchor.object.x.y, anchor.object.y.y, anchor.object.z.y};
  float z[3] = {anchor.object.x.z, anchor.object.y.z, anchor.object.z.z};
  restAxes(change, x, y, z);
  if (keepsSize) pixel.octave = strokeOctave(anchor, restStretch(change));
  pixel.along = alongAxes(anchor.object, anchor.longSide).dot(place);
  for (int k = 0; k < 3; ++k) {
    pixel.axes[k] = V3f(x[k], y[k], z[k]);
    pixel.place[k] = place[k];
    pixel.placeDx[k] = dx[k];
    pixel.placeDy[k] = dy[k];
  }
  if (!anchor.placesTurned) moveAlongAxes(place, dx, dy, pixel);
}

// Polar and seed strokes see the surface as it rests.
void moveToRest(const BrushInput& in, const BrushAnchor& anchor, int x, int y, BrushPixel& pixel) {
  const auto turned = [&](const float* d) {
    return anchor.object.x * d[0] + anchor.object.y * d[1] + anchor.object.z * d[2];
  };
  pixel.position = strokePosition(in, anchor, x, y);
  pixel.dx = turned(pixel.placeDx);
  pixel.dy = turned(pixel.placeDy);
}

BrushPixel pixelAt(const BrushInput& in, const BrushAnchor& anchor, int x, int y, const V3f& p) {
  BrushPixel pixel;
  const bool atRest = liesAtRest(in, anchor);
  const bool filtered = in.params.filter == BrushParams::Filter::anisotropic;
  pixel.position = p;
  pixel.tone = clampedUnit(in.tone(x, y));
  pixel.normal = V3f(0.0f);
  if (!in.normal.empty()) {
    const V3f n = in.normal(x, y);
    const float length = std::sqrt(n.dot(n));
    if (length > 0.0f && isFinite(n)) pixel.normal = n / length;
  }
  pixel.octave = {anchor.mappingDistance, anchor.coarser, anchor.shift, anchor.coarserShift};
  Change right, below;
  if (filtered || atRest) {
    right = changeAlong(in, atRest, x, y, 1, 0, p, pixel.tone);
    below = changeAlong(in, atRest, x, y, 0, 1, p, pixel.tone);
    pixel.dx = right.position;
    pixel.dy = below.position;
  }
  if (atRest)
    placeAtRest(anchor, in.rest(x, y), right.rest, below.rest, keepsSizeInWorld(in, anchor), pixel);
  else
    placeInObject(anchor, pixel);
  if (filtered) {
    pixel.toneDx = right.tone;
    pixel.toneDy = below.tone;
  } else if (atRest) {
    for (int k = 0; k < 3; ++k) pixel.placeDx[k] = pixel.placeDy[k] = 0.0f;
  }
  if (atRest && in.params.mapping != BrushParams::Mapping::held)
    moveToRest(in, anchor, x, y, pixel);
  return pixel;
}

Rgba seedColour(const Strip& strip, const BrushTaps& taps, float tone) {
  const Rgba first = stripBilinear(strip, taps.u[0], tone);
  const Rgba second = stripBilinear(strip, taps.u[1], tone);
  return first * taps.weight[0] + second * taps.weight[1];
}

Rgba mixedColour(const Strip& strip, const BrushTaps& taps, const BrushPixel& pixel,
                 const BrushParams& params) {
  float sum = 0, squares = 0;
  for (int i = 0; i < taps.count; ++i) sum += taps.weight[i];
  for (int i = 0; i < taps.count; ++i) squares += taps.weight[i] / sum * (taps.weight[i] / sum);
  const bool keepContrast = params.crossFade == BrushParams::CrossFade::variance;
  const float gain =
      taps.amplitude * (keepContrast ? params.contrast / std::sqrt(squares) : params.contrast);
  Rgba mixed = stripRowMean(strip, pixel.tone) * (1.0f - gain);
  for (int i = 0; i < taps.count; ++i) {
    const StripProbe probe = stripProbe(strip, taps.footprint[i], params.maxProbes);
    mixed += lookUp(strip, taps.u[i], pixel.tone, probe) * (taps.weight[i] / sum * gain);
  }
  mixed = mixed > 0.0f ? mixed : Rgba{};
  if (strip.opaque) mixed[3] = 1.0f;
  return mixed;
}

// Mixes the grain of the taps and gives it the tone's colour.
Rgba grainedColour(const Strip& strip, const BrushTaps& taps, const BrushPixel& pixel,
                   const BrushParams& params) {
  float sum = 0, squares = 0, mixed = 0;
  for (int i = 0; i < taps.count; ++i) sum += taps.weight[i];
  for (int i = 0; i < taps.count; ++i) squares += taps.weight[i] / sum * (taps.weight[i] / sum);
  const float gain =
      params.crossFade == BrushParams::CrossFade::variance ? 1.0f / std::sqrt(squares) : 1.0f;
  for (int i = 0; i < taps.count; ++i) {
    const StripProbe probe = grainProbe(strip.grain, taps.footprint[i], params.maxProbes);
    mixed +=
        lookUpGrain(strip.grain, taps.u[i], taps.across[i], probe) * (taps.weight[i] / sum * gain);
  }
  const float change = std::max(std::fabs(pixel.toneDx), std::fabs(pixel.toneDy));
  Rgba colour = grainColour(strip.grain, pixel.tone, mixed, change);
  if (params.contrast != 1.0f) {
    const Rgba mean = stripRowMean(strip, pixel.tone);
    colour = mean + (colour - mean) * params.contrast;
    colour = colour > 0.0f ? colour : Rgba{};
  }
  if (strip.opaque) colour[3] = 1.0f;
  return colour;
}

}  // namespace

V3f strokePosition(const BrushInput& in, const BrushAnchor& anchor, int x, int y) {
  if (!liesAtRest(in, anchor)) return in.position(x, y);
  const V3f place = in.rest(x, y);
  return anchor.object.origin + anchor.object.x * place.x + anchor.object.y * place.y +
         anchor.object.z * place.z;
}

Rgba brushColourAt(const BrushInput& in, const BrushAnchor& anchor, int x, int y, const V3f& p) {
  const BrushPixel pixel = pixelAt(in, anchor, x, y, p);
  const Strip& strip = in.strips[static_cast<size_t>(anchor.strip)];
  BrushTaps taps;
  if (in.params.mapping == BrushParams::Mapping::seed) {
    addSeedTaps(anchor, pixel, in.params, taps);
    return seedColour(strip, taps, pixel.tone);
  }
  if (in.params.mapping == BrushParams::Mapping::held &&
      in.params.grain == BrushParams::Grain::object) {
    const StripGrain::Level& grain = strip.grain.levels.front();
    const float aspect = static_cast<float>(grain.width) / static_cast<float>(grain.height);
    addObjectTaps(anchor, pixel, in.params, aspect, taps);
    return grainedColour(strip, taps, pixel, in.params);
  }
  if (in.params.mapping == BrushParams::Mapping::polar)
    addPolarTaps(anchor, pixel, in.params, taps);
  else
    addHeldTaps(anchor, pixel, in.params, taps);
  return mixedColour(strip, taps, pixel, in.params);
}

}  // namespace kagefude
