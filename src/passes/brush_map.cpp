#include "passes/brush_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/parallel.h"
#include "passes/brush_taps.h"
#include "passes/strip_lookup.h"

namespace kagefude {
namespace {

struct Input {
  Vec3View position, normal;
  View<const float> tone;
  View<const uint16_t> index;
  std::span<const BrushAnchor> anchors;
  std::span<const Strip> strips;
  const BrushParams& params;
};

bool isFinite(const V3f& v) {
  const float sum = v.x + v.y + v.z;
  return sum - sum == 0.0f;
}

float clampedUnit(float value) { return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f; }

struct Change {
  V3f position{0, 0, 0};
  float tone = 0;
};

// Change to the next pixel along one direction, from the neighbour before or behind that belongs
// to the same anchor and differs less; position and tone choose for themselves.
Change changeAlong(const Input& in, int x, int y, int stepX, int stepY, const V3f& p, float tone) {
  Change best;
  float smallest = -1.0f, smallestTone = -1.0f;
  for (int side = 1; side >= -1; side -= 2) {
    const int nx = x + side * stepX, ny = y + side * stepY;
    if (!in.index.contains(nx, ny) || in.index(nx, ny) != in.index(x, y)) continue;
    const V3f d = (in.position(nx, ny) - p) * static_cast<float>(side);
    const float length = d.dot(d);
    if (!(length - length == 0.0f)) continue;
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

BrushPixel pixelAt(const Input& in, int x, int y, const V3f& p) {
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

Rgba pixelColour(const Input& in, const BrushAnchor& anchor, int x, int y, const V3f& p) {
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

void writeDiagnostics(const BrushAnchor& anchor, const V3f& p, float pointBlend,
                      BrushResult& result, int x, int y) {
  const BrushPlace place = brushPlace(anchor, p, pointBlend);
  const BrushAnchor::Point& point = anchor.points[place.point + (place.next > 0.5f ? 1 : 0)];
  result.angle(x, y) = brushAngle(point.frame, point.position, p);
  result.repeat(x, y) = axisDistance(point.frame, point.position, p) / anchor.mappingDistance;
}

void checkAnchors(const Input& in) {
  for (const BrushAnchor& anchor : in.anchors) {
    if (anchor.strip < 0 || static_cast<size_t>(anchor.strip) >= in.strips.size())
      throw InputError(
          fmt::format("a style asks for strip {} of {}", anchor.strip, in.strips.size()));
    if (anchor.points.empty() || !(anchor.mappingDistance > 0.0f))
      throw InputError("a style has no reference point or no mapping distance");
  }
}

}  // namespace

BrushResult applyBrush(Vec3View position, Vec3View normal, View<const float> tone,
                       View<const uint16_t> anchorIndex, std::span<const BrushAnchor> anchors,
                       std::span<const Strip> strips, const BrushParams& params) {
  const Input in{position, normal, tone, anchorIndex, anchors, strips, params};
  checkAnchors(in);
  const int width = tone.width, height = tone.height;
  BrushResult result{Floats(width, height),
                     Floats(width, height),
                     Floats(width, height),
                     Floats(width, height),
                     Floats(),
                     Floats()};
  if (params.diagnostics) {
    result.angle = Floats(width, height, 0.0f);
    result.repeat = Floats(width, height, 0.0f);
  }
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const size_t index = anchorIndex(x, y);
        Rgba colour{};
        const V3f p = position(x, y);
        if (index > 0 && index <= anchors.size() && isFinite(p)) {
          colour = pixelColour(in, anchors[index - 1], x, y, p);
          if (params.diagnostics)
            writeDiagnostics(anchors[index - 1], p, params.pointBlend, result, x, y);
        }
        result.r(x, y) = colour[0];
        result.g(x, y) = colour[1];
        result.b(x, y) = colour[2];
        result.a(x, y) = colour[3];
      }
  });
  return result;
}

}  // namespace kagefude
