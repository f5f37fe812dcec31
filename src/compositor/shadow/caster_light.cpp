#include "compositor/shadow/caster_light.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "image/parallel.h"

namespace kagefude {

SeenSurface seenSurface(const FramePlanes& frame) {
  return {frame.position, frame.normal, frame.objectId, *frame.rays};
}

LightPlace placeOf(const Light& light) {
  return {light.type == Light::Type::sun, V3d(light.position), V3d(light.direction)};
}

uint32_t receiverId(const ShadowWork& work) {
  const std::string& name = work.light.receiver;
  std::vector<std::string> names;
  for (const auto& [id, known] : work.plan.objectNames) {
    if (known == name) return id;
    names.push_back(known);
  }
  throw InputError(fmt::format("shadow.receiver {} is no object of the frame{}; there are {}", name,
                               didYouMean(name, names), listNames(names)));
}

LightVisibility visibilityFrom(Floats hidden) {
  const View<float> plane = hidden;
  parallelRows(plane.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < plane.width; ++x) plane(x, y) = 1.0f - plane(x, y);
  });
  return {std::move(hidden), {}};
}

}  // namespace kagefude
