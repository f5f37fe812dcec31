#include "passes/depth_map/map_taps.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

struct MapPlane {
  const float* texels;
  int width, height;
};

/// Discs at most one texel too large, as they fall on the map.
struct Spans {
  int x0[MapReceivers::capacity], x1[MapReceivers::capacity];
  int y0[MapReceivers::capacity], y1[MapReceivers::capacity];
};

int floorOf(float value) {
  const int whole = static_cast<int>(value);
  return whole - (value < static_cast<float>(whole) ? 1 : 0);
}

int heldWithin(int value, int last) {
  const int capped = value < last ? value : last;
  return capped > 0 ? capped : 0;
}

KAGEFUDE_CLONES void findSpans(const MapReceivers& r, const float* radius, Spans& spans) {
  const int count = r.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const bool known = r.visibility[i] != MapReceivers::open;
    const float reach = known ? 0.0f : radius[i] + 1.0f;
    const float u = known ? 0.0f : r.u[i], v = known ? 0.0f : r.v[i];
    spans.x0[i] = floorOf(u - reach);
    spans.x1[i] = floorOf(u + reach);
    spans.y0[i] = floorOf(v - reach);
    spans.y1[i] = floorOf(v + reach);
  }
}

float lower(float a, float b) { return b < a ? b : a; }
float higher(float a, float b) { return b > a ? b : a; }

/// Bounds over the one or two by one or two nodes that each span touches.
KAGEFUDE_CLONES void findRanges(const DepthPyramid::Level& level, const Spans& spans, int count,
                                float* nearest, float* farthest) {
  const float *const near = level.nearest.data, *const far = level.farthest.data;
  const int width = level.nearest.width, shift = level.shift;
  const int lastX = width - 1, lastY = level.nearest.height - 1;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const int x0 = heldWithin(spans.x0[i] >> shift, lastX);
    const int x1 = heldWithin(spans.x1[i] >> shift, lastX);
    const int upper = heldWithin(spans.y0[i] >> shift, lastY) * width;
    const int under = heldWithin(spans.y1[i] >> shift, lastY) * width;
    nearest[i] =
        lower(lower(near[upper + x0], near[upper + x1]), lower(near[under + x0], near[under + x1]));
    farthest[i] =
        higher(higher(far[upper + x0], far[upper + x1]), higher(far[under + x0], far[under + x1]));
  }
}

template <bool perspective>
__attribute__((always_inline)) inline void decide(MapPlane map, const Spans& spans,
                                                  const float* nearest, const float* farthest,
                                                  const TapTest& test, bool hidden,
                                                  MapReceivers& r) {
  const int count = r.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float reach = test.radius[i] + 1.0f;
    const float steepness = std::sqrt(r.slopeU[i] * r.slopeU[i] + r.slopeV[i] * r.slopeV[i]);
    const MapReceivers::Bounds plane =
        r.planeDepthBounds<perspective>(i, reach, steepness, test.slopeBias);
    const bool outside = (spans.x1[i] < 0) | (spans.y1[i] < 0) | (spans.x0[i] >= map.width) |
                         (spans.y0[i] >= map.height);
    const bool inside = (spans.x0[i] >= 0) & (spans.y0[i] >= 0) & (spans.x1[i] < map.width) &
                        (spans.y1[i] < map.height);
    const float widest = 1.4143f * reach * test.spreadBias / r.texelsPerUnit[i];
    const bool lit = outside | (plane.high - test.bias[i] <= nearest[i]);
    const bool dark = hidden & inside & (plane.low - test.bias[i] - widest > farthest[i]);
    const float found = lit ? 1.0f : (dark ? 0.0f : MapReceivers::open);
    r.visibility[i] = r.visibility[i] == MapReceivers::open ? found : r.visibility[i];
  }
}

KAGEFUDE_CLONES void decideInPerspective(MapPlane map, const Spans& spans, const float* nearest,
                                         const float* farthest, const TapTest& test, bool hidden,
                                         MapReceivers& r) {
  decide<true>(map, spans, nearest, farthest, test, hidden, r);
}

KAGEFUDE_CLONES void decideOrthographic(MapPlane map, const Spans& spans, const float* nearest,
                                        const float* farthest, const TapTest& test, bool hidden,
                                        MapReceivers& r) {
  decide<false>(map, spans, nearest, farthest, test, hidden, r);
}

/// One tap of every lane.
template <bool perspective>
__attribute__((always_inline)) inline void tapLanes(MapPlane map, const MapReceivers& r,
                                                    const V2f& point, const TapTurns& turns,
                                                    const TapTest& test, const float* spread,
                                                    TapCounts& counts) {
  const float lastX = static_cast<float>(map.width - 1), endX = static_cast<float>(map.width);
  const float lastY = static_cast<float>(map.height - 1), endY = static_cast<float>(map.height);
  const int count = r.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float tu = r.u[i] + test.radius[i] * (point.x * turns.cos[i] - point.y * turns.sin[i]);
    const float tv = r.v[i] + test.radius[i] * (point.x * turns.sin[i] + point.y * turns.cos[i]);
    const bool inside = (tu >= 0.0f) & (tv >= 0.0f) & (tu < endX) & (tv < endY);
    const int column = static_cast<int>(higher(0.0f, lower(lastX, tu)));
    const int row = static_cast<int>(higher(0.0f, lower(lastY, tv)));
    const float du = static_cast<float>(column) + 0.5f - r.u[i];
    const float dv = static_cast<float>(row) + 0.5f - r.v[i];
    const float stored = map.texels[row * map.width + column];
    const float away = (du < 0.0f ? -du : du) + (dv < 0.0f ? -dv : dv);
    const float plane = r.planeDepth<perspective>(i, du, dv, test.slopeBias);
    const bool blocks = inside & (stored < plane - (test.bias[i] + away * spread[i]));
    counts.blocked[i] += blocks ? 1 : 0;
    counts.blockerDepth[i] += blocks ? stored : 0.0f;
  }
}

KAGEFUDE_CLONES void tapInPerspective(MapPlane map, const MapReceivers& r, const V2f& point,
                                      const TapTurns& turns, const TapTest& test,
                                      const float* spread, TapCounts& counts) {
  tapLanes<true>(map, r, point, turns, test, spread, counts);
}

KAGEFUDE_CLONES void tapOrthographic(MapPlane map, const MapReceivers& r, const V2f& point,
                                     const TapTurns& turns, const TapTest& test,
                                     const float* spread, TapCounts& counts) {
  tapLanes<false>(map, r, point, turns, test, spread, counts);
}

KAGEFUDE_CLONES void turnLanes(const MapReceivers& r, int y, int seed, TapTurns& turns) {
  const uint32_t rest =
      static_cast<uint32_t>(y) * 0x85ebca77u + static_cast<uint32_t>(seed) * 0xc2b2ae3du;
  const int count = r.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    uint32_t h = static_cast<uint32_t>(r.column[i]) * 0x9e3779b1u + rest;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    h ^= h >> 16;
    const SinCos turn = sinCosTurns(static_cast<float>(static_cast<int>(h >> 8)) * 0x1p-24f);
    turns.sin[i] = turn.sin;
    turns.cos[i] = turn.cos;
  }
}

}  // namespace

std::vector<V2f> spiralPoints(int n) {
  constexpr float goldenTurn = 0.38196601125f;
  std::vector<V2f> points;
  for (int i = 0; i < n; ++i) {
    const float r = std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(n));
    const SinCos turn = sinCosTurns(static_cast<float>(i) * goldenTurn);
    points.emplace_back(r * turn.cos, r * turn.sin);
  }
  return points;
}

void TapTest::setBias(const MapReceivers& receivers, float texels) {
  for (int i = 0; i < receivers.count; ++i)
    bias[i] = texels / receivers.texelsPerUnit[i] + 2e-6f * std::fabs(receivers.depth[i]);
}

TapTurns::TapTurns(const MapReceivers& receivers, int y, int seed) {
  turnLanes(receivers, y, seed, *this);
}

void settleByPyramid(const DepthPyramid& pyramid, View<const float> depth, const TapTest& test,
                     bool hidden, MapReceivers& receivers) {
  float widest = 0;
  for (int i = 0; i < receivers.count; ++i)
    if (receivers.visibility[i] == MapReceivers::open) widest = std::max(widest, test.radius[i]);
  Spans spans;
  findSpans(receivers, test.radius, spans);
  float nearest[MapReceivers::capacity], farthest[MapReceivers::capacity];
  const int texels = static_cast<int>(2.0f * (widest + 1.0f)) + 3;
  findRanges(pyramid.levelFor(texels), spans, receivers.count, nearest, farthest);
  const MapPlane map{depth.data, depth.width, depth.height};
  (receivers.perspective ? decideInPerspective : decideOrthographic)(map, spans, nearest, farthest,
                                                                     test, hidden, receivers);
}

void countTaps(View<const float> depth, const MapReceivers& receivers,
               const std::vector<V2f>& points, const TapTurns& turns, const TapTest& test,
               TapCounts& counts) {
  const MapPlane map{depth.data, depth.width, depth.height};
  float spread[MapReceivers::capacity];
  for (int i = 0; i < receivers.count; ++i) {
    spread[i] = test.spreadBias / receivers.texelsPerUnit[i];
    counts.blocked[i] = 0;
    counts.blockerDepth[i] = 0;
  }
  const auto tap = receivers.perspective ? tapInPerspective : tapOrthographic;
  for (const V2f& point : points) tap(map, receivers, point, turns, test, spread, counts);
}

}  // namespace kagefude
