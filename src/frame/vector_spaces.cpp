#include "frame/vector_spaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "frame/camera_faults.h"
#include "frame/normal_reading.h"
#include "frame/seen_places.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

using namespace detail;

template <class Convert>
void convertAll(Vec3Plane& planes, const Convert& convert) {
  parallelRows(planes.x.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < planes.x.width(); ++x) {
        const V3f v = planes.view()(x, y);
        if (v != V3f(0.0f)) planes.set(x, y, convert(v));
      }
  });
}

// As the look, the JSON, the header or, failing these, the positions themselves have the camera.
Transform cameraOfNormals(const VectorSpaces& spaces, const ImageFile& file,
                          const Vec3Plane& position) {
  const bool known = spaces.camera && spaces.camera->problem.empty();
  if (!known && spaces.position != VectorSpace::camera)
    if (const auto fitted = fitCamera(seenPoints(file, position))) return *fitted;
  return requireCamera(spaces, file, "frame.normal_space = \"camera\"").cameraFromWorld;
}

FrameCamera cameraOfLook(const AovNames& names) {
  FrameCamera camera;
  camera.source = "frame.camera_from_world";
  camera.cameraFromWorld = matrixFrom(names.cameraFromWorld);
  if (!rigidFault(camera.cameraFromWorld).empty() || handedness(camera.cameraFromWorld) < 0)
    throw LookError(
        "frame.camera_from_world is no turn and move of a right-handed space; it wants four rows "
        "of four numbers, the last row 0 0 0 1");
  return camera;
}

// It describes one camera: of a file with views, the default one.
FrameCamera cameraOfJson(const Camera& json, const ImageFile& file) {
  FrameCamera camera;
  camera.source = "the JSON's camera";
  camera.cameraFromWorld = json.cameraFromWorld;
  std::string fault = rigidFault(json.cameraFromWorld);
  if (fault.empty() && handedness(json.cameraFromWorld) < 0) fault = "mirrors";
  if (!fault.empty()) camera.problem = fmt::format("the JSON's camera_from_world {}", fault);
  if (file.views.size() > 1 && file.view != file.views.front())
    camera.problem =
        fmt::format("the JSON's camera is not said to be that of the view {}", file.view);
  const std::string unseen = projectionFault(json.clipFromCamera);
  if (unseen.empty())
    camera.clipFromCamera = json.clipFromCamera;
  else
    camera.clipProblem = fmt::format("the JSON's clip_from_camera {}", unseen);
  return camera;
}

Transform clipOfLook(const AovNames& names) {
  const Transform clip = matrixFrom(names.clipFromCamera);
  const std::string fault = projectionFault(clip);
  if (!fault.empty()) throw LookError(fmt::format("frame.clip_from_camera {}", fault));
  return clip;
}

std::optional<FrameCamera> cameraOf(const AovNames& names, const ImageFile& file,
                                    const Camera* json) {
  std::optional<FrameCamera> camera = cameraOfHeader(file);
  if (json) {
    FrameCamera described = cameraOfJson(*json, file);
    if (described.problem.empty() || !camera || !camera->problem.empty())
      camera = std::move(described);
  }
  if (!names.cameraFromWorld.empty()) {
    FrameCamera own = cameraOfLook(names);
    // What a pixel looks along does not turn with the camera.
    if (camera) own.clipFromCamera = camera->clipFromCamera;
    camera = std::move(own);
  }
  if (!names.clipFromCamera.empty() && camera) camera->clipFromCamera = clipOfLook(names);
  return camera;
}

}  // namespace

VectorSpaces vectorSpaces(const AovNames& names, const ImageFile& file, const Camera* json) {
  readingOf(names.normalAxes);
  return {names.positionSpace,        names.normalSpace, names.normalRange,
          names.normalAxes,           names.depthKind,   false,
          cameraOf(names, file, json)};
}

const FrameCamera& requireCamera(const VectorSpaces& spaces, const ImageFile& file,
                                 std::string_view needs) {
  if (!spaces.camera)
    throw InputError(fmt::format(
        "{} has no camera, which {} needs: neither the look (frame.camera_from_world) nor a JSON "
        "nor the header (worldToCamera, or V-Ray's cameraTransform) says it",
        file.path.string(), needs));
  if (!spaces.camera->problem.empty())
    throw InputError(
        fmt::format("{}: {}, so it is no camera, which {} needs; say it with "
                    "frame.camera_from_world",
                    file.path.string(), spaces.camera->problem, needs));
  return *spaces.camera;
}

std::string doubtCamera(const VectorSpaces& spaces) {
  const bool used = spaces.rebuilt || spaces.normal == VectorSpace::camera ||
                    spaces.position == VectorSpace::camera;
  return used && spaces.camera ? spaces.camera->doubt : "";
}

void convertToWorld(const VectorSpaces& spaces, const ImageFile& file, Vec3Plane& position,
                    Vec3Plane& normal) {
  NormalReading reading = readingOf(spaces.axes);
  reading.unit = spaces.range == NormalRange::unit;
  if (spaces.normal == VectorSpace::camera)
    reading.worldFromCamera = cameraOfNormals(spaces, file, position).inverse();
  if (!reading.isPlain()) convertAll(normal, [&](const V3f& v) { return reading(v); });
  if (spaces.position != VectorSpace::camera || spaces.rebuilt) return;
  const Transform worldFromCamera =
      requireCamera(spaces, file, "frame.position_space = \"camera\"").cameraFromWorld.inverse();
  convertAll(position, [&](const V3f& p) { return V3f(worldFromCamera.point(V3d(p))); });
}

}  // namespace kagefude
