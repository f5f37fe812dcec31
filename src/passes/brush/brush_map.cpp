#include "passes/brush/brush_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/parallel.h"
#include "passes/brush/brush_block.h"
#include "passes/brush/brush_pixel.h"
#include "passes/brush/brush_rows.h"
#include "passes/brush/brush_taps.h"
#include "passes/brush/grain_rows.h"
#include "passes/brush/polar_rows.h"
#include "passes/brush/seed_rows.h"

namespace kagefude {
namespace {

// Squares of places far out leave the range of a float; the count itself is held at its end.
float repeatsAt(const BrushAnchor::Point& point, const V3f& p, float mappingDistance) {
  const float repeats = axisDistance(point.frame, point.position, p) / mappingDistance;
  if (std::isfinite(repeats)) return repeats;
  const V3d q = V3d(p) - V3d(point.position);
  const double a = V3d(point.frame.l1).dot(q), b = V3d(point.frame.l2).dot(q);
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(std::hypot(a, b) / double{mappingDistance}, most));
}

// Angle and repeats of the weightiest reference point.
void writeDiagnostics(const BrushInput& in, int y, bool keepOthers, BrushResult& result) {
  for (int x = 0; x < in.index.width; ++x) {
    const size_t index = in.index(x, y);
    if (index == 0 && keepOthers) continue;
    result.angle(x, y) = result.repeat(x, y) = 0.0f;
    if (index == 0 || index > in.anchors.size() || !isFinite(in.position(x, y))) continue;
    const BrushAnchor& anchor = in.anchors[index - 1];
    const V3f p = strokePosition(in, anchor, x, y);
    const BrushPlace place = brushPlace(anchor, placeAlong(anchor, p), in.params.pointBlend);
    const BrushAnchor::Point& point = anchor.points[place.point + (place.next > 0.5f ? 1 : 0)];
    result.angle(x, y) = brushAngle(point.frame, point.position, p);
    result.repeat(x, y) = repeatsAt(point, p, anchor.mappingDistance);
  }
}

void checkAnchors(const BrushInput& in) {
  for (const BrushAnchor& anchor : in.anchors) {
    if (anchor.strip < 0 || static_cast<size_t>(anchor.strip) >= in.strips.size())
      throw InputError(
          fmt::format("a style asks for strip {} of {}", anchor.strip, in.strips.size()));
    if (anchor.points.empty() || !(anchor.mappingDistance > 0.0f))
      throw InputError("a style has no reference point or no mapping distance");
  }
}

// One pixel after the other, for what the row painter does not do.
void paintPlainly(const BrushInput& in, int first, int end, int y, ColourRows& out) {
  for (int x = first; x < end; ++x) {
    const size_t index = in.index(x, y);
    const V3f p = in.position(x, y);
    Rgba colour{};
    if (index > 0 && index <= in.anchors.size() && isFinite(p))
      colour = brushColourAt(in, in.anchors[index - 1], x, y, p);
    out.store(x, colour);
  }
}

// The grain that painted colours show, for strokes that are not made of grain.
void writeGrain(const BrushInput& in, const BrushAnchor& anchor, int x, int end, int y,
                ColourRows& out) {
  const auto brightness = [](float r, float g, float b) {
    const float luminance = 0.2126f * r + 0.7152f * g + 0.0722f * b;
    return std::sqrt(luminance > 0.0f ? luminance : 0.0f);
  };
  const Strip& strip = in.strips[static_cast<size_t>(anchor.strip)];
  for (; x < end; ++x) {
    const Rgba mean = stripRowMean(strip, clampedUnit(in.tone(x, y)));
    const float grain =
        10.0f * (brightness(out.r[x], out.g[x], out.b[x]) - brightness(mean[0], mean[1], mean[2]));
    out.grain[x] = std::clamp(grain, -StripGrain::reach, StripGrain::reach);
  }
}

/// Bands are painted in columns so wide, that a column's pixels and the parts of the strips that
/// they read stay in the cache from one row to the next.
constexpr int columnWidth = 5 * brushBlock;

// The pixels [x, stop) of a row, those of one anchor at a time.
void paintRow(const BrushInput& in, int x, int stop, int y, bool keepOthers, ColourRows& out) {
  const uint16_t* index = in.index.row(y);
  while (x < stop) {
    int end = x + 1;
    while (end < stop && index[end] == index[x]) ++end;
    const bool known = index[x] > 0 && index[x] <= in.anchors.size();
    const bool ofGrain = known && canPaintObjectRow(in, in.anchors[index[x] - 1]);
    if (known && canPaintSeedRow(in, in.anchors[index[x] - 1]))
      paintSeedRow(in, in.anchors[index[x] - 1], x, end, y, out);
    else if (ofGrain)
      paintObjectRow(in, in.anchors[index[x] - 1], x, end, y, out);
    else if (known && canPaintHeldRow(in, in.anchors[index[x] - 1]))
      paintHeldRow(in, in.anchors[index[x] - 1], x, end, y, out);
    else if (known && canPaintPolarRow(in, in.anchors[index[x] - 1]))
      paintPolarRow(in, in.anchors[index[x] - 1], x, end, y, out);
    else if (known || !keepOthers)
      paintPlainly(in, x, end, y, out);
    if (out.grain && known && !ofGrain)
      writeGrain(in, in.anchors[index[x] - 1], x, end, y, out);
    else if (out.grain && !known && !keepOthers)
      std::fill(out.grain + x, out.grain + end, 0.0f);
    x = end;
  }
}

void fit(Floats& plane, View<const float> like) {
  if (plane.width() != like.width || plane.height() != like.height)
    plane = Floats(like.width, like.height);
}

}  // namespace

void applyBrush(Vec3View position, Vec3View normal, View<const float> tone,
                View<const uint16_t> anchorIndex, std::span<const BrushAnchor> anchors,
                std::span<const Strip> strips, const BrushParams& params, BrushResult& result,
                bool keepOthers, Vec3View rest) {
  const BrushInput in{position, normal, tone, anchorIndex, anchors, strips, params, rest};
  checkAnchors(in);
  for (Floats* plane : {&result.r, &result.g, &result.b, &result.a}) fit(*plane, tone);
  if (params.diagnostics)
    for (Floats* plane : {&result.angle, &result.repeat}) fit(*plane, tone);
  if (params.keepsGrain) fit(result.grain, tone);
  parallelRows(tone.height, [&](int first, int end) {
    for (int x = 0; x < tone.width; x += columnWidth)
      for (int y = first; y < end; ++y) {
        ColourRows out{result.r.row(y), result.g.row(y), result.b.row(y), result.a.row(y),
                       params.keepsGrain ? result.grain.row(y) : nullptr};
        paintRow(in, x, std::min(x + columnWidth, tone.width), y, keepOthers, out);
      }
    for (int y = first; params.diagnostics && y < end; ++y)
      writeDiagnostics(in, y, keepOthers, result);
  });
}

BrushResult cloneColours(const BrushResult& strokes) {
  BrushResult copy;
  for (Floats BrushResult::*const plane :
       {&BrushResult::r, &BrushResult::g, &BrushResult::b, &BrushResult::a, &BrushResult::grain}) {
    const Floats& from = strokes.*plane;
    if (from.empty()) continue;
    Floats& to = copy.*plane = Floats(from.width(), from.height());
    parallelRows(from.height(), [&](int first, int end) {
      std::copy(from.row(first), from.row(end), to.row(first));
    });
  }
  return copy;
}

BrushResult applyBrush(Vec3View position, Vec3View normal, View<const float> tone,
                       View<const uint16_t> anchorIndex, std::span<const BrushAnchor> anchors,
                       std::span<const Strip> strips, const BrushParams& params) {
  BrushResult result;
  applyBrush(position, normal, tone, anchorIndex, anchors, strips, params, result);
  return result;
}

}  // namespace kagefude
