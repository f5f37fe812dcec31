#include "live/proxy.h"

#include <algorithm>

#include "compositor/scale_down.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

int samplesOf(int pixels, int step) { return std::max(1, (pixels - step / 2 + step - 1) / step); }

/// Where a sample is taken.
int placeOf(int sample, int step, int pixels) {
  return std::min(sample * step + step / 2, pixels - 1);
}

template <class T>
Plane<T> sample(const Plane<T>& plane, int step) {
  if (plane.empty()) return {};
  Plane<T> result(samplesOf(plane.width(), step), samplesOf(plane.height(), step));
  parallelRows(result.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const T* const row = plane.row(placeOf(y, step, plane.height()));
      for (int x = 0; x < result.width(); ++x) result(x, y) = row[placeOf(x, step, plane.width())];
    }
  });
  return result;
}

SparsePlane sample(const SparsePlane& plane, int step) {
  SparsePlane result(samplesOf(plane.width(), step), samplesOf(plane.height(), step));
  std::vector<uint32_t> row(static_cast<size_t>(result.width()));
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x)
      row[static_cast<size_t>(x)] =
          plane(placeOf(x, step, plane.width()), placeOf(y, step, plane.height()));
    result.setRow(y, row.data());
  }
  return result;
}

Vec3Plane sample(const Vec3Plane& planes, int step) {
  Vec3Plane result;
  result.x = sample(planes.x, step);
  result.y = sample(planes.y, step);
  result.z = sample(planes.z, step);
  return result;
}

template <class T>
std::vector<T> sample(const std::vector<T>& planes, int step) {
  std::vector<T> result;
  for (const T& plane : planes) result.push_back(sample(plane, step));
  return result;
}

CoveragePlanes sample(const CoveragePlanes& coverage, int step) {
  return {sample(coverage.firstId, step), sample(coverage.firstShare, step),
          sample(coverage.otherIds, step), sample(coverage.otherShares, step)};
}

LightPlanes sample(const LightPlanes& light, int step) {
  return {sample(light.masks, step), sample(light.traced, step),
          light.depthMap.empty() ? Floats() : light.depthMap.clone()};
}

CameraRays sample(CameraRays rays, int step) {
  // Centre i + 1/2 of a sample is centre i step + step/2 + 1/2 of the frame.
  const double shift = step / 2 + 0.5 - 0.5 * step;
  rays.origin0 += (rays.originX + rays.originY) * shift;
  rays.direction0 += (rays.directionX + rays.directionY) * shift;
  for (V3d* const perPixel : {&rays.originX, &rays.originY, &rays.directionX, &rays.directionY})
    *perPixel *= step;
  return rays;
}

Window sample(const Window& window, int step) {
  return {window.x / step, window.y / step, samplesOf(window.width, step),
          samplesOf(window.height, step)};
}

}  // namespace

int proxyStep(int width, int height, int size) {
  return std::max(1, (std::max(width, height) + size - 1) / size);
}

FramePlanes sampleFrame(const FramePlanes& planes, int step) {
  FramePlanes result;
  result.width = samplesOf(planes.width, step);
  result.height = samplesOf(planes.height, step);
  for (Vec3Plane FramePlanes::*const vectors :
       {&FramePlanes::position, &FramePlanes::normal, &FramePlanes::rest, &FramePlanes::albedo,
        &FramePlanes::beauty, &FramePlanes::lines, &FramePlanes::meanNormal})
    result.*vectors = sample(planes.*vectors, step);
  for (Floats FramePlanes::*const floats :
       {&FramePlanes::u, &FramePlanes::v, &FramePlanes::instanceRandom, &FramePlanes::alpha,
        &FramePlanes::emission, &FramePlanes::linesAlpha, &FramePlanes::depth})
    result.*floats = sample(planes.*floats, step);
  result.objectId = sample(planes.objectId, step);
  result.materialId = sample(planes.materialId, step);
  result.coverage = sample(planes.coverage, step);
  for (const LightPlanes& light : planes.lights) result.lights.push_back(sample(light, step));
  if (planes.rays) result.rays = sample(*planes.rays, step);
  result.casting = planes.casting;
  // What is doubted is doubted about the whole frame.
  result.warnings = planes.warnings;
  result.meanWarnings = planes.meanWarnings;
  result.badPixels = planes.badPixels;
  result.badBeauty = planes.badBeauty;
  result.badAlbedo = planes.badAlbedo;
  return result;
}

FramePlan samplePlan(FramePlan plan, int step) {
  plan.image.dataWindow = sample(plan.image.dataWindow, step);
  plan.image.displayWindow = sample(plan.image.displayWindow, step);
  plan.image.width = plan.image.dataWindow.width;
  plan.image.height = plan.image.dataWindow.height;
  return plan;
}

Look sampleLook(Look asked, int step) {
  const double factor = static_cast<double>(asked.output.scale) / step;
  asked.output.scale = 1;
  return multiplyPixels(std::move(asked), factor);
}

}  // namespace kagefude
