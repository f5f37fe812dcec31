#include "compositor/stroke_grounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/nearest_name.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

using Ground = BrushParams::Ground;

/// Share of a surface's pixels without rest positions from which that is worth a word.
constexpr double worthAWord = 0.02;

bool hasRest(const FramePlanes& planes, int x, int y) {
  return !planes.rest.empty() && !std::isnan(planes.rest.x(x, y));
}

bool hasUv(const FramePlanes& planes, int x, int y) {
  if (planes.u.empty()) return false;
  const float u = planes.u(x, y), v = planes.v(x, y);
  return std::isfinite(u) && std::isfinite(v) && (u != 0.0f || v != 0.0f);
}

/// Calls `each(number, first, end)` for every run of one surface's pixels in row y.
template <class Each>
void forRuns(View<const uint16_t> index, int y, const Each& each) {
  const uint16_t* row = index.row(y);
  for (int first = 0, end; first < index.width; first = end) {
    const uint16_t number = row[first];
    for (end = first + 1; end < index.width && row[end] == number;) ++end;
    if (number != 0) each(number, first, end);
  }
}

/// Images of directions under the linear part of `t`, as Transform::direction gives them.
void carryDirections(const Transform& t, const float* x, const float* y, const float* z, int count,
                     float* const* out) {
  for (int k = 0; k < 3; ++k) {
    const double a = t.m[k][0], b = t.m[k][1], c = t.m[k][2];
    float* __restrict to = out[k];
    for (int i = 0; i < count; ++i)
      to[i] = static_cast<float>(a * double{x[i]} + b * double{y[i]} + c * double{z[i]});
  }
}

/// Along an object's axes, from its origin.
Transform alongAxes(const ObjectAxes& axes) {
  Transform result;
  const V3f rows[3] = {axes.x, axes.y, axes.z};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result.m[row][column] = double{rows[row][column]};
    result.m[row][3] = -double{rows[row].dot(axes.origin)};
  }
  return result;
}

// A rest's own origin is the object's; its matrix's move would only add roundings.
Transform withoutMove(Transform t) {
  for (int row = 0; row < 3; ++row) t.m[row][3] = 0;
  return t;
}

float longestSide(const BrushSubject& subject) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    V3d side(0.0);
    side[k] = double{subject.boundsMax[k]} - double{subject.boundsMin[k]};
    longest = std::max(longest, subject.worldFromObject.direction(side).length());
  }
  return longest > 0 && std::isfinite(longest) ? static_cast<float>(longest) : 1.0f;
}

std::string nameOf(const FramePlan& plan, uint32_t object) {
  const std::string name = plan.objectName(object);
  return name.empty() ? fmt::format("{:08x}", object) : name;
}

}  // namespace

StrokeGrounds::StrokeGrounds(const FramePlan& plan, const FramePlanes& planes,
                             View<const uint16_t> index, size_t surfaces)
    : plan_(plan), surfaces_(surfaces) {
  if (planes.rest.empty() && planes.u.empty()) return;
  for (int y = 0; y < index.height; ++y)
    forRuns(index, y, [&](uint16_t number, int first, int end) {
      size_t withRest = 0, withUv = 0;
      for (int x = first; x < end; ++x) {
        withRest += hasRest(planes, x, y) ? 1 : 0;
        withUv += hasUv(planes, x, y) ? 1 : 0;
      }
      Surface& surface = surfaces_[number - 1u];
      surface.pixels += static_cast<size_t>(end - first);
      surface.withRest += withRest;
      surface.withUv += withUv;
    });
}

bool StrokeGrounds::choose(size_t number, uint32_t object, BrushParams& params) {
  Surface& surface = surfaces_[number - 1];
  const bool held = params.mapping == BrushParams::Mapping::held;
  if (params.ground == Ground::object) return false;
  if (params.ground == Ground::uv && !held) return false;
  if (params.ground == Ground::rest && (!plan_.rest || (plan_.restInWorld && !held))) return false;
  const bool uv = params.ground == Ground::uv;
  const size_t with = uv ? surface.withUv : surface.withRest;
  const auto without = static_cast<double>(surface.pixels - with);
  if (with == 0 || without > worthAWord * static_cast<double>(surface.pixels))
    missing_[with > 0][uv].insert(nameOf(plan_, object));
  if (with == 0) return false;
  surface.ground = params.ground;
  surface.uvSize = params.uvSize;
  const SidecarObject* described = plan_.findObject(object);
  const bool instanced = plan_.instanceRandom && (!described || described->instanced);
  surface.shift = instanced ? 1.0f : 0.0f;
  if (uv || plan_.restInWorld || instanced) params.points = 1;
  return true;
}

void StrokeGrounds::lay(size_t number, uint32_t object, const BrushSubject& subject,
                        BrushAnchor& anchor) {
  Surface& surface = surfaces_[number - 1];
  surface.placeFromWorld = alongAxes(anchor.object);
  const SidecarObject* described = plan_.findObject(object);
  if (surface.ground == Ground::rest && !(described && plan_.restInWorld)) {
    const Transform worldFromRest = described ? subject.worldFromObject : Transform();
    surface.placeFromRest =
        withoutMove(withoutMove(surface.placeFromWorld) * withoutMove(worldFromRest));
  }
  if (!(surface.uvSize > 0.0f)) surface.uvSize = longestSide(subject);
  anchor.placesTurned = surface.ground == Ground::uv || plan_.restInWorld;
  if (!(surface.shift > 0.0f)) return;
  // The golden section beyond whole periods, so that steps fall evenly over the strokes.
  const float period = 2.0f * pi * anchor.mappingDistance;
  surface.shift = period * (std::ceil(3.0f * longestSide(subject) / period) + 0.618034f);
  anchor.instanceStep = surface.shift;
}

V3f StrokeGrounds::placeAt(const Surface& surface, const FramePlanes& planes, int x, int y) const {
  V3f place;
  if (surface.ground == Ground::uv && hasUv(planes, x, y))
    place = V3f(planes.u(x, y) * surface.uvSize, planes.v(x, y) * surface.uvSize, 0);
  else if (surface.ground == Ground::rest && hasRest(planes, x, y))
    place = V3f(surface.placeFromRest.direction(V3d(planes.rest.view()(x, y))));
  else
    place = V3f(surface.placeFromWorld.point(V3d(planes.position.view()(x, y))));
  if (surface.shift > 0.0f && std::isfinite(planes.instanceRandom(x, y))) {
    const float random = planes.instanceRandom(x, y);
    for (int k = 0; k < 3; ++k) {
      constexpr float spread[3] = {1, 61, 3721}, most = 16;
      const float part = random * spread[k];
      place[k] += surface.shift * std::floor(most * (part - std::floor(part)));
    }
  }
  return place;
}

Vec3Plane StrokeGrounds::places(const FramePlanes& planes, View<const uint16_t> index) const {
  const auto atRest = [](const Surface& s) { return s.ground != Ground::object; };
  if (std::none_of(surfaces_.begin(), surfaces_.end(), atRest)) return {};
  Vec3Plane result(planes.width, planes.height);
  parallelRows(planes.height, [&](int top, int bottom) {
    for (int y = top; y < bottom; ++y)
      forRuns(index, y, [&](uint16_t number, int first, int end) {
        const Surface& surface = surfaces_[number - 1u];
        if (atRest(surface)) layRun(surface, planes, y, first, end, result);
      });
  });
  return result;
}

void StrokeGrounds::layRun(const Surface& surface, const FramePlanes& planes, int y, int first,
                           int end, Vec3Plane& result) const {
  const bool alike = surface.ground == Ground::rest && !(surface.shift > 0.0f);
  if (alike) {
    const Vec3View rest = planes.rest.view();
    float* const to[3] = {result.x.row(y) + first, result.y.row(y) + first,
                          result.z.row(y) + first};
    carryDirections(surface.placeFromRest, rest.x.row(y) + first, rest.y.row(y) + first,
                    rest.z.row(y) + first, end - first, to);
  }
  for (int x = first; x < end; ++x)
    if (!alike || !hasRest(planes, x, y)) result.set(x, y, placeAt(surface, planes, x, y));
}

void StrokeGrounds::noteMissing(std::vector<std::string>& warnings) const {
  for (const bool partly : {false, true})
    for (const bool uv : {false, true}) {
      const std::set<std::string>& names = missing_[partly][uv];
      if (names.empty()) continue;
      const char* const what = uv ? "UVs" : "rest positions";
      warnings.push_back(fmt::format(
          "objects hold no {}{} ({}): they are 0, not finite or without alpha, so strokes{} are "
          "held to the object; render them, or set brush.ground = \"object\"",
          what, partly ? " in some of their pixels" : "", listNames({names.begin(), names.end()}),
          partly ? " there" : ""));
    }
}

}  // namespace kagefude
