#include "frame/frame_camera.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "frame/ndc_projection.h"

namespace kagefude {
namespace {

using namespace detail;

template <class Attribute>
const Attribute* findIn(const ImageFile& file, std::initializer_list<const char*> names) {
  for (const int part : file.ownParts)
    for (const char* name : names) {
      const auto& header = (*file.headers)[static_cast<size_t>(part)];
      if (const auto* found = header.findTypedAttribute<Attribute>(name)) return found;
    }
  return nullptr;
}

Transform asGiven(const Imf::M44fAttribute& attribute) {
  Transform result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result.m[row][column] = attribute.value().x[row][column];
  return result;
}

Transform transposed(const Transform& t) {
  Transform result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result.m[row][column] = t.m[column][row];
  return result;
}

V3d columnOf(const Transform& t, int column) {
  return {t.m[0][column], t.m[1][column], t.m[2][column]};
}

double determinant(const Transform& t) {
  return columnOf(t, 0).cross(columnOf(t, 1)).dot(columnOf(t, 2));
}

double aspectOf(const ImageFile& file) {
  const Window& display = file.displayWindow;
  return static_cast<double>(display.width) * file.pixelAspect / display.height;
}

// Whether it maps by columns, its last row being 0 0 0 1.
bool isAffine(const Transform& t) {
  return t.m[3][0] == 0 && t.m[3][1] == 0 && t.m[3][2] == 0 && t.m[3][3] == 1;
}

bool isFinite(const Transform& t) {
  for (const auto& row : t.m)
    for (const double value : row)
      if (!std::isfinite(value)) return false;
  return true;
}

bool isSymmetric(const Transform& t) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < row; ++column)
      if (std::abs(t.m[row][column] - t.m[column][row]) > 1e-6) return false;
  return true;
}

// Whether nothing shows if it is written by rows or by columns.
bool isAmbiguous(const Transform& t) { return isAffine(t) && isAffine(transposed(t)); }

// "" for a rotation, mirrored or not; the same for its transposed.
std::string rigidFault(const Transform& t) {
  constexpr double most = 1e-3;
  for (int i = 0; i < 3; ++i) {
    const double length = columnOf(t, i).length();
    if (std::abs(length - 1) > most) return fmt::format("scales by {:.4g}", length);
    if (std::abs(columnOf(t, i).dot(columnOf(t, (i + 1) % 3))) > most) return "skews";
  }
  return "";
}

// The readings that a header's matrix allows: where its translation does not show whether it is
// written by rows or by columns, both, the former first, as OpenEXR says.
struct ReadMatrix {
  std::vector<bool> byRows;
  std::string fault;
};

ReadMatrix readAffine(const Transform& given) {
  ReadMatrix read;
  if (!isFinite(given)) return {{}, "holds numbers that are not finite"};
  if (isAffine(transposed(given))) read.byRows.push_back(true);
  if (isAffine(given) && !(isSymmetric(given) && !read.byRows.empty()))
    read.byRows.push_back(false);
  if (read.byRows.empty()) return {{}, "has no row or column 0 0 0 1"};
  read.fault = rigidFault(given);
  return read;
}

Transform byColumns(const Transform& given, bool byRows) {
  return byRows ? transposed(given) : given;
}

std::string doubtOrder(const std::string& source) {
  return fmt::format(
      "{} has no translation, so it does not show whether its rows or its columns are the "
      "camera's axes; it is taken by rows, as OpenEXR says (frame.camera_from_world says it)",
      source);
}

Transform lookingAlongMinusZ(Transform cameraFromWorld) {
  if (determinant(cameraFromWorld) < 0)
    for (double& value : cameraFromWorld.m[2]) value = -value;
  return cameraFromWorld;
}

// What worldToNDC says to a worldToCamera.
NdcProjection projectionBy(const Transform& cameraFromWorld, const Transform& ndcFromWorld,
                           const ImageFile& file) {
  return ndcProjection(ndcFromWorld * cameraFromWorld.inverse(), determinant(cameraFromWorld) < 0,
                       aspectOf(file), columnOf(cameraFromWorld, 3).length());
}

// The one of the orders in which worldToNDC is a projection, else the last one's fault.
void readNdc(const ImageFile& file, const Transform& toCamera, const Transform& toNdc,
             const std::vector<bool>& orders, FrameCamera& camera) {
  for (const bool cameraByRows : orders)
    for (const bool ndcByRows : {true, false}) {
      // Both are written alike; only where the camera's own reads the same either way, that may be
      // either.
      const bool sameEitherWay = orders.size() == 1 && isAmbiguous(toCamera);
      if (ndcByRows != cameraByRows && !sameEitherWay) continue;
      const Transform given = byColumns(toCamera, cameraByRows);
      const NdcProjection seen = projectionBy(given, byColumns(toNdc, ndcByRows), file);
      camera.clipProblem =
          seen.fault.empty() ? "" : fmt::format("the header's worldToNDC {}", seen.fault);
      if (!seen.fault.empty()) continue;
      camera.clipFromCamera = seen.clipFromCamera;
      camera.cameraFromWorld = given;
      return;
    }
}

FrameCamera cameraOfStandard(const ImageFile& file, const Transform& toCamera,
                             const Imf::M44fAttribute* toNdc) {
  FrameCamera camera;
  camera.source = "the header's worldToCamera";
  const ReadMatrix read = readAffine(toCamera);
  if (!read.fault.empty()) {
    camera.problem = fmt::format("{} {}", camera.source, read.fault);
    return camera;
  }
  camera.cameraFromWorld = byColumns(toCamera, read.byRows.front());
  if (toNdc) readNdc(file, toCamera, asGiven(*toNdc), read.byRows, camera);
  if (read.byRows.size() > 1 && !camera.clipFromCamera) camera.doubt = doubtOrder(camera.source);
  camera.cameraFromWorld = lookingAlongMinusZ(camera.cameraFromWorld);
  return camera;
}

std::optional<Transform> clipOfAngle(double degrees, double aspect) {
  if (!(degrees > 0) || !(degrees < 180)) return std::nullopt;
  const double scale = 1 / std::tan(degrees * M_PI / 360);
  return perspectiveClip(scale, scale * aspect, 0, 0);
}

FrameCamera cameraOfVRay(const ImageFile& file, const Transform& given) {
  FrameCamera camera;
  camera.source = "the header's cameraTransform";
  ReadMatrix read = readAffine(given);
  if (read.fault.empty() && determinant(given) < 0) read.fault = "mirrors";
  if (!read.fault.empty()) {
    camera.problem = fmt::format("{} {}", camera.source, read.fault);
    return camera;
  }
  const Transform m = byColumns(given, read.byRows.front());
  Transform worldFromCamera;
  for (int row = 0; row < 3; ++row) {
    worldFromCamera.m[row][0] = m.m[row][0];
    worldFromCamera.m[row][1] = -m.m[row][2];
    worldFromCamera.m[row][2] = m.m[row][1];
    worldFromCamera.m[row][3] = m.m[row][3];
  }
  camera.cameraFromWorld = worldFromCamera.inverse();
  if (read.byRows.size() > 1) camera.doubt = doubtOrder(camera.source);
  const auto* projection = findIn<Imf::IntAttribute>(file, {"cameraProjection"});
  const auto* angle = findIn<Imf::FloatAttribute>(file, {"cameraFov"});
  if (projection && projection->value() != 0)
    camera.clipProblem = fmt::format(
        "the header's cameraProjection is {}, which is no plain perspective", projection->value());
  else if (angle)
    camera.clipFromCamera = clipOfAngle(angle->value(), aspectOf(file));
  return camera;
}

}  // namespace

std::optional<FrameCamera> cameraOfHeader(const ImageFile& file) {
  if (!file.headers) return std::nullopt;
  using Matrix = Imf::M44fAttribute;
  if (const auto* found = findIn<Matrix>(file, {"worldToCamera", "worldtocamera"}))
    return cameraOfStandard(file, asGiven(*found),
                            findIn<Matrix>(file, {"worldToNDC", "worldtoNDC"}));
  if (const auto* found = findIn<Matrix>(file, {"cameraTransform"}))
    return cameraOfVRay(file, asGiven(*found));
  return std::nullopt;
}

Transform matrixFrom(const std::vector<float>& numbers) {
  Transform result;
  for (size_t i = 0; i < numbers.size(); ++i) result.m[i / 4][i % 4] = numbers[i];
  return result;
}

}  // namespace kagefude
