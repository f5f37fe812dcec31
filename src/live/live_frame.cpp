#include "live/live_frame.h"

#include "compositor/read_frame.h"
#include "compositor/scale_down.h"
#include "live/proxy.h"
#include "live/stage_keys.h"

namespace kagefude {
namespace {

/// Of all stages at full size: per pixel labels, joins, tone, strokes and picture, and of each
/// light its shadow before and after smoothing, and its tone.
size_t bytesOf(const FramePlanes& planes) {
  constexpr size_t ofStages = 80, ofLight = 16;
  const auto of = [](const auto& plane) {
    const auto view = plane.view();
    return view.pixels() * sizeof(*view.data);
  };
  const auto ofVectors = [&](const Vec3Plane& plane) {
    return of(plane.x) + of(plane.y) + of(plane.z);
  };
  size_t bytes = (ofStages + ofLight * planes.lights.size()) * static_cast<size_t>(planes.width) *
                 static_cast<size_t>(planes.height);
  for (const Vec3Plane* plane : {&planes.position, &planes.normal, &planes.rest, &planes.albedo,
                                 &planes.beauty, &planes.lines})
    bytes += ofVectors(*plane);
  for (const Floats* plane : {&planes.u, &planes.v, &planes.instanceRandom, &planes.emission,
                              &planes.alpha, &planes.linesAlpha, &planes.depth})
    bytes += of(*plane);
  for (const Labels* plane : {&planes.objectId, &planes.materialId}) bytes += of(*plane);
  for (const Labels& plane : planes.coverageIds) bytes += of(plane);
  for (const Floats& plane : planes.coverageShares) bytes += of(plane);
  for (const LightPlanes& light : planes.lights) {
    for (const Bytes& mask : light.masks) bytes += of(mask);
    bytes += of(light.traced) + of(light.depthMap);
  }
  return bytes;
}

}  // namespace

LivePicture LiveFrame::compose(const Look& look, StripShelf& shelf, int size,
                               std::stop_token stop) {
  StageRun run{std::move(stop)};
  LivePicture picture;
  picture.look = std::make_shared<const Look>(look);
  FramePlan plan = planFrame(look, path_, frame_, view_);
  StageKey reading;
  addReading(reading, look, plan);
  const Made<FramePlanes> planes =
      planes_.at(run, "read", std::move(reading), [&] { return readFramePlanes(plan); });
  bytes_ = bytesOf(*planes);
  picture.colour = shelf.colourOf(look, run);
  const Made<StripSet> strips = shelf.stripsOf(look, picture.colour, run);
  picture.step = size > 0 ? proxyStep(planes->width, planes->height, size) : 1;
  if (picture.step == 1) {
    picture.stages = whole_.compose(inRenderedPixels(look), strips, plan, planes, run);
    picture.plan = std::make_shared<const FramePlan>(std::move(plan));
  } else {
    StageKey sampling;
    sampling.add(planes.version).add(picture.step);
    const Made<FramePlanes> samples = samples_.at(
        run, "sample", std::move(sampling), [&] { return sampleFrame(*planes, picture.step); });
    plan = samplePlan(std::move(plan), picture.step);
    picture.stages = proxy_.compose(sampleLook(look, picture.step), strips, plan, samples, run);
    picture.plan = std::make_shared<const FramePlan>(std::move(plan));
  }
  picture.made = std::move(run.made);
  return picture;
}

}  // namespace kagefude
