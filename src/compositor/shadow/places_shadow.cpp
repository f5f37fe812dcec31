#include <cmath>

#include "compositor/shadow/caster_light.h"
#include "passes/light_shape/disc_places.h"
#include "passes/light_shape/light_shape.h"

namespace kagefude {
namespace {

/// Two unit vectors across the way from the light to what it lights.
void acrossLight(const FrameLight& light, V3f& u, V3f& v) {
  V3f axis = light.light.direction;
  if (light.light.type != Light::Type::sun && light.light.type != Light::Type::area &&
      light.subjectRadius > 0.0f)
    axis = (light.subjectCentre - light.light.position).normalized();
  // By the shortest turn from straight down, which goes smoothly with the light everywhere but
  // where it shines straight up.
  const V3f up = -axis;
  const float k = up.z > -0.9999f ? 1.0f / (1.0f + up.z) : 0.0f;
  u = V3f(1.0f - up.x * up.x * k, -up.x * up.y * k, -up.x).normalized();
  v = u.cross(up);
}

/// What moves the light from mask to mask, by one unit of place.
LightGeometry geometryOf(const FrameLight& light) {
  LightGeometry geometry;
  geometry.sun = light.light.type == Light::Type::sun;
  geometry.position = light.light.position;
  geometry.direction = light.light.direction;
  acrossLight(light, geometry.u, geometry.v);
  geometry.u *= light.light.radius;
  geometry.v *= light.light.radius;
  return geometry;
}

/// The hard mask that the light would give from a place on its disc (or round a sun's direction).
Bytes maskFrom(const V2f& place, const LightGeometry& geometry, const ShadowWork& work) {
  const Light& light = work.light.light;
  const V3f shift = geometry.u * place.x + geometry.v * place.y;
  LightPlace at = placeOf(light);
  at.position += V3d(shift);
  if (geometry.sun) at.direction = V3d((light.direction + shift).normalized());
  return hardShadowMask(seenSurface(work.frame), work.frame.casting->set, at,
                        work.light.passes.coverage);
}

}  // namespace

/// The light's disc from masks that are cut from the casters instead of rendered.
LightVisibility placesShadow(const ShadowWork& work) {
  const LightShapeParams& params = work.light.passes.lightShape;
  const LightGeometry geometry = geometryOf(work.light);
  const std::vector<V2f> places = discPlaces(work.light.castPlaces);
  std::vector<Bytes> masks;
  for (const V2f& place : places) masks.push_back(maskFrom(place, geometry, work));
  LightShapeResult shape = lightShapeVisibility(
      viewsOf(masks), places, labelsFor(params.bound, work), work.frame.position, work.frame.normal,
      geometry, params, {work.light.tellsConfidence, false});
  return {std::move(shape.visibility), std::move(shape.confidence)};
}

}  // namespace kagefude
