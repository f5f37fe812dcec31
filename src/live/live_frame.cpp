#include "live/live_frame.h"

#include <algorithm>

#include "base/glob.h"
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
                                 &planes.beauty, &planes.lines, &planes.meanNormal})
    bytes += ofVectors(*plane);
  for (const Floats* plane : {&planes.u, &planes.v, &planes.instanceRandom, &planes.emission,
                              &planes.alpha, &planes.linesAlpha, &planes.depth})
    bytes += of(*plane);
  for (const Labels* plane : {&planes.objectId, &planes.materialId}) bytes += of(*plane);
  bytes += of(planes.coverage.firstId) + of(planes.coverage.firstShare);
  for (const auto* ranks : {&planes.coverage.otherIds, &planes.coverage.otherShares})
    for (const SparsePlane& plane : *ranks) bytes += plane.bytes();
  for (const LightPlanes& light : planes.lights) {
    for (const Bytes& mask : light.masks) bytes += of(mask);
    bytes += of(light.traced) + of(light.depthMap);
  }
  return bytes;
}

/// The centre and four places round it, the fewest that method places takes: each of them costs a
/// mask, and between them the light's shape is filled in as between nine.
void takeFewPlaces(FramePlan& plan, const std::vector<std::string>& moving) {
  constexpr int few = 5;
  for (FrameLight& light : plan.lights)
    if (matchesAny(light.name, moving)) light.castPlaces = std::min(light.castPlaces, few);
}

}  // namespace

LivePicture LiveFrame::compose(const Look& look, StripShelf& shelf, int size, std::stop_token stop,
                               int coarser, const std::vector<std::string>& moving) {
  StageRun run{std::move(stop)};
  LivePicture picture;
  picture.look = std::make_shared<const Look>(look);
  FramePlan plan = planFrame(look, path_, frame_, view_);
  StageKey reading;
  addReading(reading, look, plan);
  const Made<FramePlanes> planes = planes_.at(run, "read", std::move(reading), [&] {
    proxies_.clear();  // what they hold is of the frame before
    return readFramePlanes(plan);
  });
  picture.colour = shelf.colourOf(look, run);
  const Made<StripSet> strips = shelf.stripsOf(look, picture.colour, run);
  if (size > 0) picture.step = coarser * proxyStep(planes->width, planes->height, size);
  if (picture.step > 1) takeFewPlaces(plan, moving);
  compose(picture, strips, std::move(plan), planes, run);
  picture.made = std::move(run.made);
  return picture;
}

void LiveFrame::compose(LivePicture& picture, const Made<StripSet>& strips, FramePlan plan,
                        const Made<FramePlanes>& planes, StageRun& run) {
  const int step = picture.step;
  if (step == 1) {
    picture.stages = whole_.compose(inRenderedPixels(*picture.look), strips, plan, planes, run);
  } else {
    Proxy& proxy = proxies_[step];
    StageKey sampling;
    sampling.add(planes.version);
    const Made<FramePlanes> samples = proxy.samples.at(run, "sample", std::move(sampling),
                                                       [&] { return sampleFrame(*planes, step); });
    plan = samplePlan(std::move(plan), step);
    picture.stages =
        proxy.stages.compose(sampleLook(*picture.look, step), strips, plan, samples, run);
  }
  picture.plan = std::make_shared<const FramePlan>(std::move(plan));
  const size_t whole = bytesOf(*planes);
  bytes_ = whole;
  for (const auto& [each, proxy] : proxies_)
    bytes_ += whole / (static_cast<size_t>(each) * static_cast<size_t>(each));
}

}  // namespace kagefude
