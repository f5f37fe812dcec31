#include "compositor/doubt_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace kagefude {
namespace {

/// A place in its object's space, and the camera there.
struct Place {
  V3d seen, camera, low, high;
};

struct Box {
  Transform objectFromWorld;
  V3d camera, low, high;
};

Box boxOf(const SidecarObject& object, const V3d& camera) {
  constexpr double around = 0.02;
  Box box;
  box.objectFromWorld = object.worldFromObject.inverse();
  box.camera = box.objectFromWorld.point(camera);
  const V3d margin(around * (object.boundsMax - object.boundsMin).length());
  box.low = object.boundsMin - margin;
  box.high = object.boundsMax + margin;
  return box;
}

std::vector<Place> placesOf(const FramePlan& plan, const FramePlanes& planes) {
  constexpr double wanted = 4096;
  const V3d camera = plan.spaces.camera->cameraFromWorld.inverse().point({0, 0, 0});
  const double pixels = static_cast<double>(planes.width) * planes.height;
  const int stride = std::max(1, static_cast<int>(std::sqrt(pixels / wanted)));
  std::map<uint32_t, Box> boxes;
  std::vector<Place> places;
  for (int y = stride / 2; y < planes.height; y += stride)
    for (int x = stride / 2; x < planes.width; x += stride) {
      const uint32_t id = planes.objectId(x, y);
      const SidecarObject* object = id == 0 ? nullptr : plan.findObject(id);
      if (!object || object->instanced) continue;
      const auto [found, isNew] = boxes.try_emplace(id);
      if (isNew) found->second = boxOf(*object, camera);
      const Box& box = found->second;
      const V3d seen = box.objectFromWorld.point(V3d(planes.position.view()(x, y)));
      places.push_back({seen, box.camera, box.low, box.high});
    }
  return places;
}

/// Share of the places that lie in their bounds, had the depth been `factor` times as large.
double shareInside(const std::vector<Place>& places, double factor) {
  const auto inside = [&](const Place& place) {
    const V3d p = place.camera + (place.seen - place.camera) * factor;
    return p.x >= place.low.x && p.y >= place.low.y && p.z >= place.low.z && p.x <= place.high.x &&
           p.y <= place.high.y && p.z <= place.high.z;
  };
  const auto count = std::count_if(places.begin(), places.end(), inside);
  return static_cast<double>(count) / static_cast<double>(places.size());
}

/// The factor between usual units by which the most places fit; 1 where none is much better.
double fittingFactor(const std::vector<Place>& places) {
  constexpr double units[] = {2.54, 3.2808399, 10, 12, 30.48, 39.370079, 100, 304.8, 1000};
  constexpr double fits = 0.8;
  double best = 1, most = fits;
  for (const double unit : units)
    for (const double factor : {unit, 1 / unit}) {
      const double share = shareInside(places, factor);
      if (share <= most) continue;
      best = factor;
      most = share;
    }
  return best;
}

}  // namespace

std::string doubtBounds(const FramePlan& plan, const FramePlanes& planes) {
  constexpr size_t fewestPlaces = 64;
  constexpr double enough = 0.5;
  if (!plan.spaces.rebuilt || !plan.sidecar) return "";
  const std::vector<Place> places = placesOf(plan, planes);
  if (places.size() < fewestPlaces) return "";
  const double share = shareInside(places, 1);
  if (share >= enough) return "";
  const std::string few = fmt::format(
      "only {:.0f} % of the rebuilt positions lie in the bounds that the JSON gives their objects",
      100 * share);
  // A parallel camera's rays do not meet in it.
  const bool perspective = plan.spaces.camera->clipFromCamera->m[3][2] != 0;
  const double factor = perspective ? fittingFactor(places) : 1;
  if (factor == 1)
    return fmt::format("{}, so the depth or {} is not what it is taken for", few,
                       plan.spaces.camera->source);
  return fmt::format(
      "{}, {:.0f} % if the depth were {:.4g} times as large; it counts in the world's units "
      "(oiiotool --mulc {:.4g} changes them)",
      few, 100 * shareInside(places, factor), factor, factor);
}

}  // namespace kagefude
