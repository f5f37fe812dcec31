#include "frame/vector_spaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
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
  const auto& m = camera.cameraFromWorld.m;
  const V3d x(m[0][0], m[0][1], m[0][2]), y(m[1][0], m[1][1], m[1][2]),
      z(m[2][0], m[2][1], m[2][2]);
  const bool affine = m[3][0] == 0 && m[3][1] == 0 && m[3][2] == 0 && m[3][3] == 1;
  if (!affine || (x.cross(y) - z).length() > 1e-3 || std::abs(x.length() - 1) > 1e-3 ||
      std::abs(y.length() - 1) > 1e-3)
    throw LookError(
        "frame.camera_from_world is no turn and move of a right-handed space; it wants four rows "
        "of four numbers, the last row 0 0 0 1");
  return camera;
}

Transform clipOfLook(const AovNames& names) {
  const Transform clip = matrixFrom(names.clipFromCamera);
  const auto& w = clip.m[3];
  const bool perspective = w[0] == 0 && w[1] == 0 && w[2] < 0 && w[3] == 0;
  const bool parallel = w[0] == 0 && w[1] == 0 && w[2] == 0 && w[3] == 1;
  if ((!perspective && !parallel) || clip.m[0][0] * clip.m[1][1] - clip.m[0][1] * clip.m[1][0] == 0)
    throw LookError(
        "frame.clip_from_camera is no projection of a camera that looks along -z; its last row is "
        "0 0 -1 0, of a parallel one 0 0 0 1");
  return clip;
}

std::optional<FrameCamera> cameraOf(const AovNames& names, const ImageFile& file,
                                    const Camera* json) {
  std::optional<FrameCamera> camera = cameraOfHeader(file);
  if (json)
    camera =
        FrameCamera{json->cameraFromWorld, json->clipFromCamera, "the JSON's camera", "", "", ""};
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
