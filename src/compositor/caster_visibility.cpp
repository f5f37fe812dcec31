#include "compositor/caster_visibility.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "frame/casters.h"
#include "image/parallel.h"
#include "passes/light_shape/disc_places.h"
#include "picture/strip_file.h"

namespace kagefude {
namespace {

SeenSurface seenSurface(const FramePlanes& frame) {
  return {frame.position, frame.normal, frame.objectId, frame.casting->rays};
}

LightPlace placeOf(const Light& light) {
  return {light.type == Light::Type::sun, V3d(light.position), V3d(light.direction)};
}

/// Two unit vectors across the way from the light to what it lights.
void acrossLight(const FrameLight& light, V3f& u, V3f& v) {
  V3f axis = light.light.direction;
  if (light.light.type != Light::Type::sun && light.light.type != Light::Type::area &&
      light.subjectRadius > 0.0f)
    axis = (light.subjectCentre - light.light.position).normalized();
  const V3f helper = std::fabs(axis.z) < 0.9f ? V3f(0, 0, 1) : V3f(1, 0, 0);
  u = helper.cross(axis).normalized();
  v = axis.cross(u);
}

uint32_t idOf(const FramePlan& plan, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [id, known] : plan.objectNames) {
    if (known == name) return id;
    names.push_back(known);
  }
  throw InputError(fmt::format("shadow.receiver {} is no object of the frame{}; there are {}", name,
                               didYouMean(name, names), listNames(names)));
}

Floats blobPicture(const std::filesystem::path& file) {
  if (file.empty()) return {};
  StripPicture picture = readStrip(file);
  Floats grey(picture.width(), picture.height());
  for (size_t i = 0; i < grey.view().pixels(); ++i)
    grey.row(0)[i] = (picture.red.row(0)[i] + picture.green.row(0)[i] + picture.blue.row(0)[i]) / 3;
  return grey;
}

Floats blobVisibility(const FrameLight& light, const FramePlan& plan, const FramePlanes& frame) {
  const uint32_t receiver = idOf(plan, light.receiver);
  const ReceiverPlane ground = planeOfReceiver(seenSurface(frame), receiver, light.receiver);
  std::vector<BlobPlace> places;
  std::vector<uint32_t> ids;
  if (plan.sidecar)
    for (const SidecarObject& object : plan.sidecar->objects) {
      if (object.flat || object.name == light.receiver) continue;
      places.push_back(blobUnder(object.worldFromObject, object.boundsMin, object.boundsMax,
                                 ground.normal, ground.normal.dot(ground.point),
                                 light.passes.blob));
      ids.push_back(plan.idSource == IdSource::index ? object.index : object.cryptoId);
    }
  const Floats picture = blobPicture(light.blob);
  return blobTone(frame.position, frame.objectId, places, ids, picture, light.passes.blob);
}

void invert(View<float> plane) {
  parallelRows(plane.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < plane.width; ++x) plane(x, y) = 1.0f - plane(x, y);
  });
}

}  // namespace

CastingScene readCastingScene(const FramePlan& plan) {
  CastingScene scene;
  if (!plan.sidecar)
    throw InputError(fmt::format("{} has no sidecar, whose camera this shadow method needs",
                                 plan.image.path.string()));
  const Camera& camera = plan.sidecar->camera;
  const Window& data = plan.image.dataWindow;
  const Window& display = plan.image.displayWindow;
  scene.rays = cameraRays(
      camera.clipFromCamera, camera.cameraFromWorld, camera.position, !camera.perspective,
      V2f(static_cast<float>(display.width), static_cast<float>(display.height)),
      Window{data.x - display.x, data.y - display.y, data.width, data.height});
  std::map<std::string, uint32_t> ids;
  for (const auto& [id, name] : plan.objectNames) ids[name] = id;
  FrameCasters casters = readCasters(plan.sidecar->path, ids);
  scene.meshes = std::move(casters.meshes);
  scene.warnings = std::move(casters.warnings);
  scene.set = CasterSet(scene.meshes);
  return scene;
}

Floats casterVisibility(const FrameLight& light, const FramePlan& plan, const FramePlanes& frame) {
  const SeenSurface surface = seenSurface(frame);
  const CastingScene& scene = *frame.casting;
  Floats hidden;
  switch (light.method) {
    case ShadowMethod::blob:
      return blobVisibility(light, plan, frame);
    case ShadowMethod::volume:
      hidden =
          shadowVolume(surface, scene.meshes, scene.set, placeOf(light.light), light.passes.volume);
      break;
    case ShadowMethod::planar: {
      const uint32_t receiver = idOf(plan, light.receiver);
      hidden = planarShadow(surface, receiver, planeOfReceiver(surface, receiver, light.receiver),
                            scene.meshes, scene.set, placeOf(light.light), light.passes.planar);
      break;
    }
    default:
      hidden = shadowCoverage(surface, scene.set, placeOf(light.light), light.passes.coverage);
      coverageToVisibility(hidden, light.passes.coverage);
      return hidden;
  }
  invert(hidden);
  return hidden;
}

CastMasks castMasks(const FrameLight& light, const FramePlanes& frame) {
  CastMasks cast;
  cast.places = discPlaces(light.castPlaces);
  LightGeometry& geometry = cast.geometry;
  geometry.sun = light.light.type == Light::Type::sun;
  geometry.position = light.light.position;
  geometry.direction = light.light.direction;
  acrossLight(light, geometry.u, geometry.v);
  geometry.u *= light.light.radius;
  geometry.v *= light.light.radius;
  const SeenSurface surface = seenSurface(frame);
  for (const V2f& place : cast.places) {
    const V3f shift = geometry.u * place.x + geometry.v * place.y;
    LightPlace at = placeOf(light.light);
    at.position += V3d(shift);
    if (geometry.sun) at.direction = V3d((light.light.direction + shift).normalized());
    cast.masks.push_back(hardShadowMask(surface, frame.casting->set, at, light.passes.coverage));
  }
  return cast;
}

}  // namespace kagefude
