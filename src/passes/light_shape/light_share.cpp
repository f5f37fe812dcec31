#include "passes/light_shape/light_share.h"

#include <algorithm>
#include <cmath>

#include "image/real_math.h"

namespace kagefude {
namespace {

/// Circumradius of the regular octagon that has the unit circle's area.
constexpr float octagonRadius = 1.05390736f;
constexpr float halfRoot2 = 0.70710678f;

/// Arc sine by the angle of (√(1 - x²), x), so that the bits are the same on every machine.
float arcSine(float x) {
  const float turns = turnsOf(x, std::sqrt(std::max(0.0f, 1.0f - x * x)));
  return 2 * pi * (turns > 0.5f ? turns - 1.0f : turns);
}

}  // namespace

float positiveShare(float a, float b, float c) {
  const int positive = (a > 0) + (b > 0) + (c > 0);
  if (positive == 0) return 0.0f;
  if (positive == 3) return 1.0f;
  // Bring the corner that stands alone to the front.
  const bool sign = positive == 1;
  float lone = a, other = b, third = c;
  if ((b > 0) == sign) std::swap(lone, other);
  if ((c > 0) == sign) std::swap(lone, third);
  const float tip = lone * lone / ((lone - other) * (lone - third));
  return sign ? tip : 1.0f - tip;
}

float positiveShare(float a, float b) {
  if (a > 0 && b > 0) return 1.0f;
  if (a > 0) return a / (a - b);
  if (b > 0) return b / (b - a);
  return 0.0f;
}

float discShare(float distance) {
  const float d = std::clamp(distance, -1.0f, 1.0f);
  return std::clamp(0.5f + (d * std::sqrt(1.0f - d * d) + arcSine(d)) / pi, 0.0f, 1.0f);
}

bool placesOnLine(std::span<const V2f> places) {
  return std::all_of(places.begin(), places.end(), [](const V2f& p) { return p.y == 0.0f; });
}

bool placesOnRing(std::span<const V2f> places) {
  constexpr float close = 0.01f;  // radii; a JSON may round
  if (places.size() != 5 && places.size() != 9) return false;
  const auto ring = places.subspan(1);
  const SinCos step = sinCosTurns(1.0f / static_cast<float>(ring.size()));
  const auto isClose = [&](const V2f& a, const V2f& b) {
    return std::fabs(a.x - b.x) < close && std::fabs(a.y - b.y) < close;
  };
  const auto turnsBy = [&](float sine) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const V2f& p = ring[i];
      const V2f next(p.x * step.cos - p.y * sine, p.x * sine + p.y * step.cos);
      if (!isClose(ring[(i + 1) % ring.size()], next)) return false;
    }
    return true;
  };
  return isClose(places[0], V2f(0, 0)) && std::fabs(ring[0].length() - 1.0f) < close &&
         (turnsBy(step.sin) || turnsBy(-step.sin));
}

bool placesOnRectangle(std::span<const V2f> places) {
  constexpr float close = 0.01f;  // a JSON may round
  const auto holds = [&](float x, float y) {
    return std::any_of(places.begin(), places.end(), [&](const V2f& p) {
      return std::fabs(p.x - x) < close && std::fabs(p.y - y) < close;
    });
  };
  return holds(-1, -1) && holds(1, -1) && holds(-1, 1) && holds(1, 1);
}

LightShare::LightShare(std::span<const V2f> places, bool linear, float radius)
    : places_(places.begin(), places.end()),
      line_(placesOnLine(places)),
      linear_(linear),
      ring_(placesOnRing(places)),
      rectangle_(placesOnRectangle(places)),
      radius_(radius) {
  if (!line_ && !linear_ && !ring_) buildMesh();
  moment_ = 0.5f * static_cast<float>(places.size() - 1);
  if (ring_) return;
  moment_ = 0;
  for (const V2f& p : places_) moment_ += 0.5f * (p.x * p.x + p.y * p.y);
  if (!line_ && linear_) fitPlane();
}

/// Least squares for places that do not balance about the centre; those that do need no matrix.
void LightShare::fitPlane() {
  const double n = static_cast<double>(places_.size());
  double su = 0, sv = 0, uu = 0, uv = 0, vv = 0;
  for (const V2f& p : places_) {
    su += p.x;
    sv += p.y;
    uu += double{p.x} * p.x;
    uv += double{p.x} * p.y;
    vv += double{p.y} * p.y;
  }
  constexpr double balanced = 0.15;  // of a mask's share: the groups of discPlaces
  const double off = std::max({std::fabs(su), std::fabs(sv), std::fabs(uv), std::fabs(uu - vv)});
  if (!rectangle_ && off < balanced * n) return;
  const double mu = su / n, mv = sv / n;
  const double a = uu - n * mu * mu, b = uv - n * mu * mv, d = vv - n * mv * mv;
  const double determinant = a * d - b * b;
  if (!(determinant > 1e-9 * n)) return;
  for (const V2f& p : places_) {
    const double x = p.x - mu, y = p.y - mv;
    const double u = (d * x - b * y) / determinant, v = (a * y - b * x) / determinant;
    fit_.emplace_back(static_cast<float>(1 / n - mu * u - mv * v), static_cast<float>(u),
                      static_cast<float>(v));
  }
}

void LightShare::buildMesh() {
  const LightMesh mesh(places_);
  if (!(mesh.area() > 0.0f)) return;
  triangles_.assign(mesh.triangles().begin(), mesh.triangles().end());
  for (LightMesh::Triangle& t : triangles_) t.area /= mesh.area();
  // As the octagon below: a disc's mesh grows until its area is the disc's.
  const float reach = rectangle_ ? radius_ : radius_ * std::sqrt(pi / mesh.area());
  for (const V2f& place : places_) corners_.push_back(mesh.blendAt(place * reach));
}

float LightShare::meanOf(const float* s) const {
  const auto lit = std::count_if(s, s + places_.size(), [](float d) { return d > 0.0f; });
  return static_cast<float>(lit) / static_cast<float>(places_.size());
}

float LightShare::ofMesh(const float* s) const {
  if (triangles_.empty()) return meanOf(s);
  float value[mostMasks], sum = 0.0f;
  for (size_t i = 0; i < corners_.size(); ++i) {
    const LightMesh::Blend& c = corners_[i];
    value[i] = c.weight[0] * s[c.mask[0]] + c.weight[1] * s[c.mask[1]] + c.weight[2] * s[c.mask[2]];
  }
  for (const LightMesh::Triangle& t : triangles_)
    sum += t.area * positiveShare(value[t.corner[0]], value[t.corner[1]], value[t.corner[2]]);
  return std::clamp(sum, 0.0f, 1.0f);
}

float LightShare::of(const float* s) const {
  if (line_) return ofLine(s);
  if (linear_) return ofPlane(s);
  return ring_ ? ofWedges(s) : ofMesh(s);
}

float LightShare::ofLine(const float* s) const {
  const size_t last = places_.size() - 1;
  const auto at = [&](float u) {
    size_t i = 1;
    while (i < last && places_[i].x < u) ++i;
    const float gap = places_[i].x - places_[i - 1].x;
    const float t = gap > 0.0f ? (u - places_[i - 1].x) / gap : 0.5f;
    return s[i - 1] + t * (s[i] - s[i - 1]);
  };
  const float middle = 0.5f * (places_[0].x + places_[last].x);
  const float reach = 0.5f * (places_[last].x - places_[0].x) * radius_;
  if (!(places_[last].x > places_[0].x)) return meanOf(s);
  if (!(reach > 0)) return at(middle) > 0 ? 1.0f : 0.0f;
  const float low = middle - reach, high = middle + reach;
  float sum = 0.0f, from = low, value = at(low);
  for (size_t i = 0; i <= last; ++i) {
    if (places_[i].x <= low || places_[i].x >= high) continue;
    sum += (places_[i].x - from) * positiveShare(value, s[i]);
    from = places_[i].x;
    value = s[i];
  }
  sum += (high - from) * positiveShare(value, at(high));
  return std::clamp(sum / (high - low), 0.0f, 1.0f);
}

float LightShare::ofPlane(const float* s) const {
  const float count = static_cast<float>(places_.size());
  float mean = 0, u = 0, v = 0;
  for (size_t k = 0; k < places_.size(); ++k) {
    mean += s[k];
    u += s[k] * places_[k].x;
    v += s[k] * places_[k].y;
  }
  mean /= count;
  float slope = std::sqrt(u * u + v * v) / moment_ * radius_;
  if (!fit_.empty()) {
    V3f plane(0.0f);
    for (size_t k = 0; k < places_.size(); ++k) plane += fit_[k] * s[k];
    mean = plane.x;
    slope = std::sqrt(plane.y * plane.y + plane.z * plane.z) * radius_;
    if (rectangle_ && slope > 1e-6f)
      return rectangleShare(mean, plane.y * radius_, plane.z * radius_);
  }
  if (!(slope > 1e-6f)) return (radius_ > 0 ? mean : s[0]) > 0 ? 1.0f : 0.0f;
  return discShare(mean / slope);
}

/// Exact: the plane through the corners, over both halves of the rectangle.
float LightShare::rectangleShare(float mean, float u, float v) const {
  const float a = mean - u - v, b = mean + u - v, c = mean + u + v, d = mean - u + v;
  return 0.5f * (positiveShare(a, b, c) + positiveShare(a, c, d));
}

float LightShare::ofWedges(const float* s) const {
  const size_t ring = places_.size() - 1;
  const float centre = s[0], reach = radius_ * octagonRadius;
  // With a ring of 4, a vertex half way between two masks lies on their wedge's plane.
  float corner[8];
  for (size_t i = 0; i < 8; ++i) {
    const size_t k = i * ring / 8;
    const float rise = ring == 8 || i % 2 == 0
                           ? s[1 + k] - centre
                           : halfRoot2 * (s[1 + k] + s[1 + (k + 1) % ring] - 2 * centre);
    corner[i] = centre + reach * rise;
  }
  float sum = 0.0f;
  for (size_t i = 0; i < 8; ++i) sum += positiveShare(centre, corner[i], corner[(i + 1) % 8]);
  return sum / 8.0f;
}

}  // namespace kagefude
