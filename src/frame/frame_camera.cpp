#include "frame/frame_camera.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "frame/camera_faults.h"
#include "frame/ndc_projection.h"

namespace kagefude {
namespace {

using namespace detail;

template <class Attribute>
const Attribute* findIn(const ImageFile& file, const char* name) {
  for (const int part : file.ownParts) {
    const auto& header = (*file.headers)[static_cast<size_t>(part)];
    if (const auto* found = header.findTypedAttribute<Attribute>(name)) return found;
  }
  return nullptr;
}

template <class Matrix>
Transform asGiven(const Matrix& matrix) {
  Transform result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result.m[row][column] = static_cast<double>(matrix.x[row][column]);
  return result;
}

std::optional<Transform> matrixIn(const Imf::Header& header, const char* name) {
  if (const auto* found = header.findTypedAttribute<Imf::M44fAttribute>(name))
    return asGiven(found->value());
  if (const auto* found = header.findTypedAttribute<Imf::M44dAttribute>(name))
    return asGiven(found->value());
  return std::nullopt;
}

bool isSame(const Transform& a, const Transform& b) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const double size = 1 + std::abs(a.m[row][column]);
      if (std::abs(a.m[row][column] - b.m[row][column]) > 1e-4 * size) return false;
    }
  return true;
}

std::string labelOf(const Part& part) {
  return part.name.empty() ? part.file.filename().string() : part.name;
}

// A part that names no view speaks for the default one.
std::string viewFault(const ImageFile& file, const Part& part) {
  if (file.views.size() < 2 || part.view == file.view || file.view == file.views.front()) return "";
  return fmt::format("is not said to be that of the view {}", file.view);
}

struct HeaderMatrix {
  Transform given;
  int part = 0;
  std::string fault;  ///< why it must not be used, to follow its name
};

// The first own part's that has one; parts of one view must agree.
std::optional<HeaderMatrix> findMatrix(const ImageFile& file,
                                       std::initializer_list<const char*> names) {
  std::optional<HeaderMatrix> first;
  for (const int number : file.ownParts)
    for (const char* name : names) {
      const auto found = matrixIn((*file.headers)[static_cast<size_t>(number)], name);
      if (!found) continue;
      const Part& part = file.parts[static_cast<size_t>(number)];
      if (!first) {
        first = HeaderMatrix{*found, number, viewFault(file, part)};
        continue;
      }
      const Part& firstPart = file.parts[static_cast<size_t>(first->part)];
      if (first->fault.empty() && part.view == firstPart.view && !isSame(*found, first->given))
        first->fault =
            fmt::format("is another one in {} than in {}", labelOf(part), labelOf(firstPart));
    }
  return first;
}

Transform transposed(const Transform& t) {
  Transform result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result.m[row][column] = t.m[column][row];
  return result;
}

V3d placeOf(const Transform& t) { return {t.m[0][3], t.m[1][3], t.m[2][3]}; }

double aspectOf(const ImageFile& file) {
  const Window& display = file.displayWindow;
  return static_cast<double>(display.width) * file.pixelAspect / display.height;
}

bool isSymmetric(const Transform& t) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < row; ++column)
      if (std::abs(t.m[row][column] - t.m[column][row]) > 1e-6) return false;
  return true;
}

// Whether nothing shows if it is written by rows or by columns.
bool isAmbiguous(const Transform& t) { return isAffine(t) && isAffine(transposed(t)); }

// The readings that a header's matrix allows: where its translation does not show whether it is
// written by rows or by columns, both, the former first, as OpenEXR says.
struct ReadMatrix {
  std::vector<bool> byRows;
  std::string fault;
};

Transform byColumns(const Transform& given, bool byRows) {
  return byRows ? transposed(given) : given;
}

ReadMatrix readAffine(const HeaderMatrix& found) {
  if (!found.fault.empty()) return {{}, found.fault};
  const Transform& given = found.given;
  ReadMatrix read;
  if (isAffine(transposed(given))) read.byRows.push_back(true);
  if (isAffine(given) && !(isSymmetric(given) && !read.byRows.empty()))
    read.byRows.push_back(false);
  // Also where numbers are not finite, which rigidFault says first.
  read.fault = rigidFault(byColumns(given, !read.byRows.empty() && read.byRows.front()));
  if (read.byRows.empty() && read.fault.find("finite") == std::string::npos)
    read.fault = "has no row or column 0 0 0 1";
  return read;
}

std::string doubtOrder(const std::string& source) {
  return fmt::format(
      "{} has no translation, so it does not show whether its rows or its columns are the "
      "camera's axes; it is taken by rows, as OpenEXR says (frame.camera_from_world says it)",
      source);
}

Transform lookingAlongMinusZ(Transform cameraFromWorld) {
  if (handedness(cameraFromWorld) < 0)
    for (double& value : cameraFromWorld.m[2]) value = -value;
  return cameraFromWorld;
}

// What worldToNDC says to a worldToCamera.
NdcProjection projectionBy(const Transform& cameraFromWorld, const Transform& ndcFromWorld,
                           const ImageFile& file) {
  return ndcProjection(ndcFromWorld * cameraFromWorld.inverse(), handedness(cameraFromWorld) < 0,
                       aspectOf(file), placeOf(cameraFromWorld).length());
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

FrameCamera cameraOfStandard(const ImageFile& file, const HeaderMatrix& toCamera,
                             const std::optional<HeaderMatrix>& toNdc) {
  FrameCamera camera;
  camera.source = "the header's worldToCamera";
  const ReadMatrix read = readAffine(toCamera);
  if (!read.fault.empty()) {
    camera.problem = fmt::format("{} {}", camera.source, read.fault);
    return camera;
  }
  camera.cameraFromWorld = byColumns(toCamera.given, read.byRows.front());
  if (toNdc && toNdc->fault.empty())
    readNdc(file, toCamera.given, toNdc->given, read.byRows, camera);
  else if (toNdc)
    camera.clipProblem = fmt::format("the header's worldToNDC {}", toNdc->fault);
  if (read.byRows.size() > 1 && !camera.clipFromCamera) camera.doubt = doubtOrder(camera.source);
  camera.cameraFromWorld = lookingAlongMinusZ(camera.cameraFromWorld);
  return camera;
}

// V-Ray's: `degrees` are those across.
void readAngle(double degrees, double aspect, FrameCamera& camera) {
  if (!(degrees > 0) || !(degrees < 180)) {
    camera.clipProblem =
        fmt::format("the header's cameraFov of {:.4g} degrees is no angle of view", degrees);
    return;
  }
  const double scale = 1 / std::tan(degrees * M_PI / 360);
  const Transform clip = perspectiveClip(scale, scale * aspect, 0, 0);
  const std::string fault = projectionFault(clip);
  if (fault.empty())
    camera.clipFromCamera = clip;
  else
    camera.clipProblem = fmt::format("the header's cameraFov {}", fault);
}

FrameCamera cameraOfVRay(const ImageFile& file, const HeaderMatrix& found) {
  FrameCamera camera;
  camera.source = "the header's cameraTransform";
  ReadMatrix read = readAffine(found);
  if (read.fault.empty() && handedness(found.given) < 0) read.fault = "mirrors";
  if (!read.fault.empty()) {
    camera.problem = fmt::format("{} {}", camera.source, read.fault);
    return camera;
  }
  const Transform m = byColumns(found.given, read.byRows.front());
  Transform worldFromCamera;
  for (int row = 0; row < 3; ++row) {
    worldFromCamera.m[row][0] = m.m[row][0];
    worldFromCamera.m[row][1] = -m.m[row][2];
    worldFromCamera.m[row][2] = m.m[row][1];
    worldFromCamera.m[row][3] = m.m[row][3];
  }
  camera.cameraFromWorld = worldFromCamera.inverse();
  if (read.byRows.size() > 1) camera.doubt = doubtOrder(camera.source);
  const auto* projection = findIn<Imf::IntAttribute>(file, "cameraProjection");
  const auto* angle = findIn<Imf::FloatAttribute>(file, "cameraFov");
  if (projection && projection->value() != 0)
    camera.clipProblem = fmt::format(
        "the header's cameraProjection is {}, which is no plain perspective", projection->value());
  else if (angle)
    readAngle(angle->value(), aspectOf(file), camera);
  return camera;
}

}  // namespace

std::optional<FrameCamera> cameraOfHeader(const ImageFile& file) {
  if (!file.headers) return std::nullopt;
  if (const auto found = findMatrix(file, {"worldToCamera", "worldtocamera"}))
    return cameraOfStandard(file, *found, findMatrix(file, {"worldToNDC", "worldtoNDC"}));
  if (const auto found = findMatrix(file, {"cameraTransform"})) return cameraOfVRay(file, *found);
  return std::nullopt;
}

Transform matrixFrom(const std::vector<float>& numbers) {
  Transform result;
  for (size_t i = 0; i < numbers.size(); ++i) result.m[i / 4][i % 4] = numbers[i];
  return result;
}

}  // namespace kagefude
