#include "frame/vector_spaces.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
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

Transform requireCamera(const VectorSpaces& spaces, const ImageFile& file, const char* key) {
  if (spaces.cameraFromWorld) return *spaces.cameraFromWorld;
  throw InputError(fmt::format(
      "{} has neither a JSON nor a worldToCamera attribute, so {} = \"camera\" has no camera to "
      "turn by; export the camera with the frame, or render world space",
      file.path.string(), key));
}

// As the JSON, the header or, failing both, the positions themselves have the camera.
Transform cameraOfNormals(const VectorSpaces& spaces, const ImageFile& file,
                          const Vec3Plane& position) {
  if (!spaces.cameraFromWorld && spaces.position != VectorSpace::camera)
    if (const auto fitted = fitCamera(seenPoints(file, position))) return *fitted;
  return requireCamera(spaces, file, "frame.normal_space");
}

std::optional<Transform> cameraOfHeader(const ImageFile& file) {
  for (const char* name : {"worldToCamera", "worldtocamera"}) {
    const auto* found = file.leadingHeader().findTypedAttribute<Imf::M44fAttribute>(name);
    if (!found) continue;
    Transform result;  // row vectors there, columns here
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        result.m[row][column] = found->value().x[column][row];
    return result;
  }
  return std::nullopt;
}

}  // namespace

VectorSpaces vectorSpaces(const AovNames& names, const ImageFile& file) {
  readingOf(names.normalAxes);
  return {names.positionSpace, names.normalSpace, names.normalRange, names.normalAxes,
          cameraOfHeader(file)};
}

void convertToWorld(const VectorSpaces& spaces, const ImageFile& file, Vec3Plane& position,
                    Vec3Plane& normal) {
  NormalReading reading = readingOf(spaces.axes);
  reading.unit = spaces.range == NormalRange::unit;
  if (spaces.normal == VectorSpace::camera)
    reading.worldFromCamera = cameraOfNormals(spaces, file, position).inverse();
  if (!reading.isPlain()) convertAll(normal, [&](const V3f& v) { return reading(v); });
  if (spaces.position != VectorSpace::camera) return;
  const Transform worldFromCamera = requireCamera(spaces, file, "frame.position_space").inverse();
  convertAll(position, [&](const V3f& p) { return V3f(worldFromCamera.point(V3d(p))); });
}

}  // namespace kagefude
