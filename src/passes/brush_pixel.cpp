#include "passes/brush_pixel.h"

#include <algorithm>
#include <cmath>

#include "passes/brush_taps.h"
#include "passes/strip_lookup.h"

namespace kagefude {
namespace {

struct Change {
  V3f position{0, 0, 0};
  float tone = 0;
};

// Change to the next pixel along one direction, from the neighbour before or behind that belongs
// to the same anchor and differs less; position and tone choose for themselves.
Change changeAlong(const BrushInput& in, int x, int y, int stepX, int stepY, const V3f& p,
                   float tone) {
  Change best;
  float smallest = -1.0f, smallestTone = -1.0f;
  for (int side = 1; side >= -1; side -= 2) {
    const int nx = x + side * stepX, ny = y + side * stepY;
    if (!in.index.contains(nx, ny) || in.index(nx, ny) != in.index(x, y)) continue;
    const V3f neighbour = in.position(nx, ny);
    if (!isFinite(neighbour)) continue;
    const V3f d = (neighbour - p) * static_cast<float>(side);
    const float length = d.dot(d);
    if (smallest < 0.0f || length < smallest) {
      smallest = length;
      best.position = d;
    }
    const float dTone = (clampedUnit(in.tone(nx, ny)) - tone) * static_cast<float>(side);
    if (smallestTone < 0.0f || std::fabs(dTone) < smallestTone) {
      smallestTone = std::fabs(dTone);
      best.tone = dTone;
    }
  }
  return best;
}

BrushPixel pixelAt(const BrushInput& in, int x, int y, const V3f& p) {
  BrushPixel pixel;
  pixel.position = p;
  pixel.tone = clampedUnit(in.tone(x, y));
  pixel.normal = V3f(0.0f);
  if (!in.normal.empty()) {
    const V3f n = in.normal(x, y);
    const float length = std::sqrt(n.dot(n));
    if (length > 0.0f && isFinite(n)) pixel.normal = n / length;
  }
  if (in.params.filter == BrushParams::Filter::bilinear) return pixel;
  const Change right = changeAlong(in, x, y, 1, 0, p, pixel.tone);
  const Change below = changeAlong(in, x, y, 0, 1, p, pixel.tone);
  pixel.dx = right.position;
  pixel.toneDx = right.tone;
  pixel.dy = below.position;
  pixel.toneDy = below.tone;
  return pixel;
}

Rgba seedColour(const Strip& strip, const BrushTaps& taps, float tone) {
  const Rgba first = stripBilinear(strip, taps.u[0], tone);
  const Rgba second = stripBilinear(strip, taps.u[1], tone);
  return first * taps.weight[0] + second * taps.weight[1];
}

Rgba mixedColour(const Strip& strip, const BrushTaps& taps, const BrushPixel& pixel,
                 const BrushParams& params) {
  const float amplitude = taps.amplitude * params.contrast;
  if (taps.count == 1 && amplitude == 1.0f)
    return lookUp(strip, taps.u[0], pixel.tone,
                  stripProbe(strip, taps.footprint[0], params.maxProbes));
  Rgba colours{};
  float sum = 0, squares = 0;
  for (int i = 0; i < taps.count; ++i) {
    const StripProbe probe = stripProbe(strip, taps.footprint[i], params.maxProbes);
    colours += lookUp(strip, taps.u[i], pixel.tone, probe) * taps.weight[i];
    sum += taps.weight[i];
    squares += taps.weight[i] * taps.weight[i];
  }
  const Rgba plain = colours / sum;
  const bool keepContrast = params.crossFade == BrushParams::CrossFade::variance && taps.count > 1;
  if (amplitude == 1.0f && !keepContrast) return plain;
  const float gain = keepContrast ? amplitude * sum / std::sqrt(squares) : amplitude;
  const float dv = std::max(std::fabs(pixel.toneDx), std::fabs(pixel.toneDy));
  const Rgba mean = stripRowMean(strip, pixel.tone, dv);
  const Rgba mixed = mean + (plain - mean) * gain;
  return mixed > 0.0f ? mixed : Rgba{};
}

}  // namespace

Rgba brushColourAt(const BrushInput& in, const BrushAnchor& anchor, int x, int y, const V3f& p) {
  const BrushPixel pixel = pixelAt(in, x, y, p);
  const Strip& strip = in.strips[static_cast<size_t>(anchor.strip)];
  BrushTaps taps;
  if (in.params.mapping == BrushParams::Mapping::seed) {
    addSeedTaps(anchor, pixel, in.params, taps);
    return seedColour(strip, taps, pixel.tone);
  }
  if (in.params.mapping == BrushParams::Mapping::polar)
    addPolarTaps(anchor, pixel, in.params, taps);
  else
    addHeldTaps(anchor, pixel, in.params, taps);
  return mixedColour(strip, taps, pixel, in.params);
}

}  // namespace kagefude
