#include "passes/light_shape/light_mesh.h"

#include <algorithm>

namespace kagefude {
namespace {

double cross(const V2f& a, const V2f& b, const V2f& c) {
  return (static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y) -
         (static_cast<double>(b.y) - a.y) * (static_cast<double>(c.x) - a.x);
}

/// Height over the paraboloid whose lower hull is the triangulation. The nudge decides between
/// places on one circle, always alike.
double lift(std::span<const V2f> places, size_t i) {
  constexpr double nudge = 1e-7;
  const double x = places[i].x, y = places[i].y, n = static_cast<double>(i);
  return x * x + y * y + nudge * n * n;
}

/// Whether no other place lies below the plane through three lifted ones in turning order.
bool isLowest(std::span<const V2f> p, size_t a, size_t b, size_t c, double doubleArea) {
  for (size_t d = 0; d < p.size(); ++d) {
    if (d == a || d == b || d == c) continue;
    const double plane =
        (cross(p[d], p[b], p[c]) * lift(p, a) + cross(p[a], p[d], p[c]) * lift(p, b) +
         cross(p[a], p[b], p[d]) * lift(p, c)) /
        doubleArea;
    if (lift(p, d) < plane) return false;
  }
  return true;
}

}  // namespace

LightMesh::LightMesh(std::span<const V2f> places) : places_(places.begin(), places.end()) {
  constexpr double smallest = 1e-6;
  for (size_t a = 0; a < places.size(); ++a)
    for (size_t b = a + 1; b < places.size(); ++b)
      for (size_t c = a + 1; c < places.size(); ++c) {
        const double doubleArea = cross(places[a], places[b], places[c]);
        if (b == c || !(doubleArea > smallest) || !isLowest(places, a, b, c, doubleArea)) continue;
        triangles_.push_back(
            {{static_cast<uint32_t>(a), static_cast<uint32_t>(b), static_cast<uint32_t>(c)},
             static_cast<float>(0.5 * doubleArea)});
        area_ += triangles_.back().area;
      }
}

LightMesh::Blend LightMesh::blendIn(const Triangle& t, const V2f& place) const {
  const V2f &a = places_[t.corner[0]], &b = places_[t.corner[1]], &c = places_[t.corner[2]];
  const double area = cross(a, b, c);
  const auto first = static_cast<float>(cross(place, b, c) / area);
  const auto second = static_cast<float>(cross(a, place, c) / area);
  return {{t.corner[0], t.corner[1], t.corner[2]}, {first, second, 1.0f - first - second}};
}

LightMesh::Blend LightMesh::blendAt(const V2f& place) const {
  const auto least = [](const Blend& b) {
    return std::min({b.weight[0], b.weight[1], b.weight[2]});
  };
  Blend best{{0, 0, 0}, {1, 0, 0}};
  float inside = -1e30f;
  for (const Triangle& t : triangles_) {
    const Blend blend = blendIn(t, place);
    if (least(blend) <= inside) continue;
    inside = least(blend);
    best = blend;
  }
  return best;
}

}  // namespace kagefude
