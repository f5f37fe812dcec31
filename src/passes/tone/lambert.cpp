#include "passes/tone/lambert.h"

#include <cmath>

#include "image/parallel.h"

namespace kagefude {
namespace {

V3f unitOrZero(const V3f& v) {
  const float length = std::sqrt(v.dot(v));
  return length > 0.0f ? v / length : V3f(0.0f);
}

// False for NaN as well, so that a bad pixel becomes 0.
float clampedUnit(float value) { return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f; }

}  // namespace

V3f towardsLight(const Light& light, const V3f& p) {
  return light.type == Light::Type::sun ? -unitOrZero(light.direction)
                                        : unitOrZero(light.position - p);
}

float spotFalloff(const Light& light, const V3f& p) {
  if (light.type != Light::Type::spot) return 1.0f;
  const float edge = sinCosTurns(light.spotAngle / (4.0f * pi)).cos;
  const float zone = (1.0f - edge) * light.spotBlend;
  const float inside = -towardsLight(light, p).dot(unitOrZero(light.direction)) - edge;
  if (!(inside > 0.0f)) return 0.0f;
  if (inside >= zone) return 1.0f;
  const float t = inside / zone;
  return t * t * (3.0f - 2.0f * t);
}

Floats lambertShade(Vec3View normal, Vec3View position, View<const uint32_t> labels,
                    const Light& light, const LambertParams& params) {
  Floats shade(normal.width(), normal.height());
  const bool cone = params.spotCone && light.type == Light::Type::spot;
  parallelRows(normal.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < normal.width(); ++x) {
        if (labels(x, y) == 0) {
          shade(x, y) = 0;
          continue;
        }
        const V3f p = position(x, y);
        const float cosine = unitOrZero(normal(x, y)).dot(towardsLight(light, p));
        const float value = clampedUnit((cosine + params.wrap) / (1.0f + params.wrap));
        shade(x, y) = cone ? value * spotFalloff(light, p) : value;
      }
  });
  return shade;
}

}  // namespace kagefude
