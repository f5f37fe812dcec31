#include "compositor/casting_scene.h"

#include <fmt/format.h>

#include "base/error.h"
#include "compositor/frame_plan.h"
#include "frame/casters.h"

namespace kagefude {
namespace {

CameraRays raysOf(const FramePlan& plan, const Camera& camera) {
  const Window& data = plan.image.dataWindow;
  const Window& display = plan.image.displayWindow;
  return cameraRays(camera.clipFromCamera, camera.cameraFromWorld, camera.position,
                    !camera.perspective,
                    V2f(static_cast<float>(display.width), static_cast<float>(display.height)),
                    Window{data.x - display.x, data.y - display.y, data.width, data.height});
}

}  // namespace

std::optional<CameraRays> raysOf(const FramePlan& plan, bool needed) {
  if (!plan.sidecar && needed)
    throw InputError(fmt::format("{} has no sidecar, whose camera this shadow method needs",
                                 plan.image.path.string()));
  try {
    if (plan.sidecar) return raysOf(plan, plan.sidecar->camera);
    const std::optional<FrameCamera>& known = plan.spaces.camera;
    if (!known || !known->clipFromCamera || !known->problem.empty() || !known->doubt.empty())
      return {};
    Camera camera;
    camera.cameraFromWorld = known->cameraFromWorld;
    camera.clipFromCamera = *known->clipFromCamera;
    camera.perspective = camera.clipFromCamera.m[3][2] != 0;
    camera.position = camera.cameraFromWorld.inverse().point({0, 0, 0});
    return raysOf(plan, camera);
  } catch (const InputError&) {
    if (needed) throw;
    return {};
  }
}

CastingScene readCastingScene(const FramePlan& plan) {
  CastingScene scene;
  std::map<std::string, uint32_t> ids;
  for (const auto& [id, name] : plan.objectNames) ids[name] = id;
  FrameCasters casters = readCasters(*plan.sidecar, ids);
  scene.meshes = std::move(casters.meshes);
  scene.warnings = std::move(casters.warnings);
  scene.set = CasterSet(scene.meshes);
  return scene;
}

}  // namespace kagefude
