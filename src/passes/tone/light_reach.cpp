#include "passes/tone/light_reach.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr float nearest = 1e-6f;

float lengthOf(const V3f& v) { return std::sqrt(v.dot(v)); }

}  // namespace

float emissionCosine(const Light& light, const V3f& p) {
  if (light.type != Light::Type::area) return 1.0f;
  const V3f way = p - light.position;
  const float length = lengthOf(way) * lengthOf(light.direction);
  if (!(length > 0.0f)) return 1.0f;
  const float cosine = way.dot(light.direction) / length;
  return cosine > 0.0f ? std::min(cosine, 1.0f) : 0.0f;
}

float irradianceOnAxis(const Light& light, const LightPower& power, const V3f& p) {
  if (light.type == Light::Type::sun || !power.falls) return power.watts;
  const float distance = std::max({lengthOf(p - light.position), light.radius, nearest});
  const float round = light.type == Light::Type::area ? 4.0f : 4.0f * pi;
  return power.watts / (round * distance * distance);
}

Floats lightReach(Vec3View position, View<const uint32_t> labels, const Light& light,
                  const LightPower& power, bool irradiance, float most) {
  Floats reach(labels.width, labels.height);
  parallelRows(labels.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < labels.width; ++x) {
        if (labels(x, y) == 0) {
          reach(x, y) = 0;
          continue;
        }
        const V3f p = position(x, y);
        const float cosine = emissionCosine(light, p);
        reach(x, y) =
            irradiance ? cosine * irradianceOnAxis(light, power, p) : std::min(cosine, most);
      }
  });
  return reach;
}

}  // namespace kagefude
