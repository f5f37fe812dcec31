#include "frame/rebuild_positions.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

using namespace detail;

constexpr float farthest = 9e9f;

bool isBackground(float depth) { return depth <= 0 || depth > farthest; }

bool isPerspective(const Transform& clip) {
  return clip.m[3][0] != 0 || clip.m[3][1] != 0 || clip.m[3][2] != 0;
}

// The camera-space point at z = -depth that clip space shows at (x, y).
V3d pointAt(const Transform& clip, double x, double y, double depth) {
  const auto& m = clip.m;
  const double a = m[0][0] - x * m[3][0], b = m[0][1] - x * m[3][1];
  const double c = m[1][0] - y * m[3][0], d = m[1][1] - y * m[3][1];
  const double e = (m[0][2] - x * m[3][2]) * depth - (m[0][3] - x * m[3][3]);
  const double f = (m[1][2] - y * m[3][2]) * depth - (m[1][3] - y * m[3][3]);
  const double whole = a * d - b * c;
  return {(e * d - b * f) / whole, (a * f - e * c) / whole, -depth};
}

template <class Counts>
size_t countDepths(View<const float> depth, const Counts& counts) {
  std::atomic<size_t> sum = 0;
  parallelRows(depth.height, [&](int first, int end) {
    size_t own = 0;
    for (int y = first; y < end; ++y)
      for (int x = 0; x < depth.width; ++x) own += counts(depth(x, y)) ? 1 : 0;
    sum += own;
  });
  return sum;
}

size_t countSeen(View<const float> depth) {
  return countDepths(depth, [](float d) { return !isBackground(d); });
}

void refuseNegative(View<const float> depth, const ImageFile& file) {
  if (countSeen(depth) == 0 && countDepths(depth, [](float d) { return d < 0; }) > 0)
    throw InputError(fmt::format(
        "{} has no depth above 0, but some below; positions are rebuilt from depths that grow away "
        "from the camera (oiiotool --mulc -1 turns them round)",
        file.path.string()));
}

// Positions are floats of world space: far from its origin their steps swallow what a pixel shows.
void refuseFarOrigin(View<const float> depth, const FrameCamera& camera,
                     const Transform& worldFromCamera, const ImageFile& file) {
  const auto& clip = *camera.clipFromCamera;
  const V3d place = worldFromCamera.point({0, 0, 0});
  const double step = place.length() * std::numeric_limits<float>::epsilon();
  const double pixel = 2 / (std::abs(clip.m[0][0]) * file.displayWindow.width);
  const bool perspective = isPerspective(clip);
  const size_t swallowed = countDepths(depth, [&](float d) {
    return !isBackground(d) && (perspective ? pixel * double{d} : pixel) < step;
  });
  if (2 * swallowed > countSeen(depth))
    throw InputError(fmt::format(
        "{}: {} stands {:.3g} units from the world's origin, where a float's steps of {:.2g} are "
        "wider than most of the pixels, so positions cannot be rebuilt; move the scene nearer to "
        "the origin, or say another camera with frame.camera_from_world",
        file.path.string(), camera.source, place.length(), step));
}

}  // namespace

std::string rebuildFault(const VectorSpaces& spaces) {
  const auto& camera = spaces.camera;
  if (!camera)
    return "no camera is known: neither the look (frame.camera_from_world) nor a JSON nor the "
           "header (worldToCamera, or V-Ray's cameraTransform) says it";
  if (!camera->problem.empty())
    return fmt::format("{}; say it with frame.camera_from_world", camera->problem);
  if (camera->clipFromCamera) return "";
  if (!camera->clipProblem.empty())
    return fmt::format("{}; say it with frame.clip_from_camera", camera->clipProblem);
  return fmt::format(
      "{} comes without its field of view (worldToNDC, V-Ray's cameraFov, or "
      "frame.clip_from_camera)",
      camera->source);
}

Vec3Plane rebuildPositions(View<const float> depth, const VectorSpaces& spaces,
                           const ImageFile& file) {
  if (const std::string fault = rebuildFault(spaces); !fault.empty())
    throw InputError(
        fmt::format("{}: no positions can be rebuilt, for {}", file.path.string(), fault));
  refuseNegative(depth, file);
  const Transform& clip = *spaces.camera->clipFromCamera;
  const Transform worldFromCamera = spaces.camera->cameraFromWorld.inverse();
  refuseFarOrigin(depth, *spaces.camera, worldFromCamera, file);
  const bool ray = spaces.measuredAlong() == DepthKind::ray && isPerspective(clip);
  const Window &data = file.dataWindow, &display = file.displayWindow;
  Vec3Plane positions(depth.width, depth.height);
  parallelRows(depth.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < depth.width; ++x) {
        if (isBackground(depth(x, y))) {
          positions.set(x, y, V3f(0.0f));
          continue;
        }
        const double column = 2 * (data.x - display.x + x + 0.5) / display.width - 1;
        const double row = 1 - 2 * (data.y - display.y + y + 0.5) / display.height;
        const V3d ahead = pointAt(clip, column, row, ray ? 1 : depth(x, y));
        const V3d seen = ray ? ahead * (depth(x, y) / ahead.length()) : ahead;
        positions.set(x, y, V3f(worldFromCamera.point(seen)));
      }
  });
  return positions;
}

Vec3Plane rebuiltOtherwise(Vec3View position, const VectorSpaces& spaces) {
  const Transform& cameraFromWorld = spaces.camera->cameraFromWorld;
  const Transform worldFromCamera = cameraFromWorld.inverse();
  const bool ray = spaces.measuredAlong() == DepthKind::ray;
  Vec3Plane other(position.width(), position.height());
  parallelRows(position.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < position.width(); ++x) {
        const V3f p = position(x, y);
        if (p == V3f(0.0f)) {
          other.set(x, y, p);
          continue;
        }
        const V3d seen = cameraFromWorld.point(V3d(p));
        const double stretch = -seen.z / seen.length();
        other.set(x, y, V3f(worldFromCamera.point(seen * (ray ? 1 / stretch : stretch))));
      }
  });
  return other;
}

}  // namespace kagefude
