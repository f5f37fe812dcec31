#include "compositor/motion_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "compositor/position_pass.h"
#include "compositor/rest_pass.h"
#include "exr/read_channels.h"
#include "frame/cryptomatte.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

Vec3Plane expectedPositions(const MotionFrame& now, const MotionFrame& before) {
  std::map<uint32_t, Transform> moves;  // worldBefore from worldNow
  for (const auto& [id, worldNow] : now.worldFromObject) {
    const auto found = before.worldFromObject.find(id);
    if (found != before.worldFromObject.end()) moves[id] = found->second * worldNow.inverse();
  }
  Vec3Plane expected(now.ids.width(), now.ids.height());
  parallelRows(now.ids.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < now.ids.width(); ++x) {
        const V3f p = now.position.view()(x, y);
        const auto move = moves.find(now.ids(x, y));
        expected.set(x, y, move == moves.end() ? p : V3f(move->second.point(V3d(p))));
      }
  });
  return expected;
}

std::set<uint32_t> idsAtRest(const MotionFrame& frame) {
  std::set<uint32_t> ids;
  if (frame.rest.x.empty()) return ids;
  uint32_t last = 0;
  for (size_t i = 0; i < frame.ids.view().pixels(); ++i) {
    const uint32_t id = frame.ids.row(0)[i];
    if (id == last || id == 0 || std::isnan(frame.rest.x.row(0)[i])) continue;
    ids.insert(id);
    last = id;
  }
  return ids;
}

/// A frame's positions, with rest positions in the pixels of `ids`.
Vec3Plane withRest(View<const uint32_t> pixels, Vec3View position, Vec3View rest,
                   const std::set<uint32_t>& ids) {
  Vec3Plane result(pixels.width, pixels.height);
  parallelRows(pixels.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < pixels.width; ++x) {
        const bool atRest = ids.count(pixels(x, y)) != 0;
        result.set(x, y, atRest ? rest(x, y) : position.empty() ? V3f(0.0f) : position(x, y));
      }
  });
  return result;
}

bool sameMatrix(const Transform& a, const Transform& b) {
  return std::equal(&a.m[0][0], &a.m[0][0] + 16, &b.m[0][0]);
}

bool lensChanged(const MotionFrame& now, const MotionFrame& before) {
  return now.clipFromCamera && before.clipFromCamera &&
         !sameMatrix(*now.clipFromCamera, *before.clipFromCamera);
}

/// Motion to where the camera before saw the expected positions.
void projectMotion(const MotionFrame& before, Vec3View expected, Floats& motionX, Floats& motionY) {
  const Transform clipFromWorld = *before.clipFromCamera * *before.cameraFromWorld;
  const Window &data = before.dataWindow, &display = before.displayWindow;
  motionX = Floats(expected.width(), expected.height());
  motionY = Floats(expected.width(), expected.height());
  parallelRows(expected.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < expected.width(); ++x) {
        const V3d clip = clipFromWorld.point(V3d(expected(x, y)));
        const double column = display.x - data.x + (0.5 + 0.5 * clip.x) * display.width - 0.5;
        const double row = display.y - data.y + (0.5 - 0.5 * clip.y) * display.height - 0.5;
        motionX(x, y) = static_cast<float>(column - x);
        motionY(x, y) = static_cast<float>(y - row);
      }
  });
}

}  // namespace

MotionFrame readMotionFrame(const Look& look, const std::filesystem::path& path, int frame) {
  const FramePlan plan = planFrame(look, path, frame);
  const Aov vector = requireAov(plan.image, look.frame, AovKind::vector);
  MotionFrame result;
  ChannelReader reader(plan.image);
  PositionPass positions;
  requestPositions(reader, plan, positions);
  reader.floats(vector.channels.at(0), result.motionX);
  reader.floats(vector.channels.at(1), result.motionY);
  Floats restAlpha;
  if (plan.rest) {
    reader.floats(plan.rest->channels.at(0), result.rest.x);
    reader.floats(plan.rest->channels.at(1), result.rest.y);
    reader.floats(plan.rest->channels.at(2), result.rest.z);
    if (plan.rest->channels.size() > 3) reader.floats(plan.rest->channels[3], restAlpha);
  }
  CryptomattePlanes matte;
  Floats index;
  if (plan.idSource == IdSource::cryptomatte)
    matte = requestCryptomatte(reader, plan.objectId.name, dominantRanks);
  else
    reader.floats(plan.objectId.channels.at(0), index);
  reader.read();
  if (plan.rest) markWithoutRest(restAlpha, result.rest);
  result.position = takePositions(plan, positions);
  VectorSpaces spaces = plan.spaces;
  spaces.normal = VectorSpace::automatic;
  spaces.range = NormalRange::automatic;
  spaces.axes.clear();
  Vec3Plane noNormals;
  convertToWorld(spaces, plan.image, result.position, noNormals);
  result.ids = index.empty() ? dominantIds(matte) : roundIndices(index);
  result.dataWindow = plan.image.dataWindow;
  result.displayWindow = plan.image.displayWindow;
  const View<const uint32_t> ids = result.ids;
  for (const uint32_t id : std::set<uint32_t>(ids.data, ids.data + ids.pixels()))
    if (const std::string name = plan.objectName(id); id != 0 && !name.empty())
      result.names.emplace(id, name);
  if (!plan.sidecar) return result;
  result.cameraFromWorld = plan.sidecar->camera.cameraFromWorld;
  result.clipFromCamera = plan.sidecar->camera.clipFromCamera;
  for (const SidecarObject& object : plan.sidecar->objects)
    result.worldFromObject.emplace(
        plan.idSource == IdSource::index ? object.index : object.cryptoId, object.worldFromObject);
  result.sidecar = plan.sidecar;
  return result;
}

PreviousPlaces previousPlaces(const MotionFrame& now, const MotionFrame& before) {
  if (now.ids.width() != before.ids.width() || now.ids.height() != before.ids.height())
    throw InputError(fmt::format("neighbouring frames are of {}x{} and {}x{} pixels",
                                 before.ids.width(), before.ids.height(), now.ids.width(),
                                 now.ids.height()));
  MotionInput in{now.ids, before.ids, now.motionX, now.motionY, now.position, {}, {}};
  const bool described = !now.worldFromObject.empty() && !before.worldFromObject.empty();
  Vec3Plane expected;
  Floats motionX, motionY;
  if (described) {
    expected = expectedPositions(now, before);
    in.expected = expected;
    in.previousPosition = before.position;
    if (lensChanged(now, before)) {
      projectMotion(before, expected, motionX, motionY);
      in.motionX = motionX;
      in.motionY = motionY;
    }
  }
  std::set<uint32_t> atRest = idsAtRest(before);
  const std::set<uint32_t> restNow = idsAtRest(now);
  std::erase_if(atRest, [&](uint32_t id) { return restNow.count(id) == 0; });
  if (atRest.empty()) return findPreviousPlaces(in);
  // Without matrices 0 stands for all else: nothing is hidden there.
  const Vec3View none;
  const Vec3Plane position =
      withRest(now.ids, described ? now.position.view() : none, now.rest, atRest);
  const Vec3Plane placesNow =
      withRest(now.ids, described ? expected.view() : none, now.rest, atRest);
  const Vec3Plane placesBefore =
      withRest(before.ids, described ? before.position.view() : none, before.rest, atRest);
  in.position = position;
  in.expected = placesNow;
  in.previousPosition = placesBefore;
  return findPreviousPlaces(in);
}

}  // namespace kagefude
