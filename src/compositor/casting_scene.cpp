#include "compositor/casting_scene.h"

#include <fmt/format.h>

#include "base/error.h"
#include "compositor/frame_plan.h"
#include "frame/casters.h"

namespace kagefude {

CameraRays raysOf(const FramePlan& plan) {
  if (!plan.sidecar)
    throw InputError(fmt::format("{} has no sidecar, whose camera this shadow method needs",
                                 plan.image.path.string()));
  const Camera& camera = plan.sidecar->camera;
  const Window& data = plan.image.dataWindow;
  const Window& display = plan.image.displayWindow;
  return cameraRays(camera.clipFromCamera, camera.cameraFromWorld, camera.position,
                    !camera.perspective,
                    V2f(static_cast<float>(display.width), static_cast<float>(display.height)),
                    Window{data.x - display.x, data.y - display.y, data.width, data.height});
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
