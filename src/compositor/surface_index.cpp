#include "compositor/surface_index.h"

#include <fmt/format.h>

#include <functional>
#include <unordered_map>

#include "base/error.h"

namespace kagefude {
namespace {

struct SurfaceHash {
  size_t operator()(const Surface& s) const {
    return std::hash<uint64_t>()(static_cast<uint64_t>(s.object) << 32 | s.material);
  }
};

}  // namespace

SurfaceIndex indexSurfaces(const FramePlanes& frame) {
  constexpr size_t mostSurfaces = 65535;
  SurfaceIndex result{Plane<uint16_t>(frame.width, frame.height), {}};
  std::unordered_map<Surface, uint16_t, SurfaceHash> numbers;
  Surface last;
  uint16_t lastNumber = 0;
  const bool materials = !frame.materialId.empty();
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const uint32_t object = frame.objectId(x, y);
      const Surface surface{object, object && materials ? frame.materialId(x, y) : 0};
      if (!(surface == last)) {
        last = surface;
        lastNumber = 0;
        if (object) {
          const auto [found, isNew] =
              numbers.try_emplace(surface, static_cast<uint16_t>(numbers.size() + 1));
          if (isNew) result.surfaces.push_back(surface);
          if (result.surfaces.size() > mostSurfaces)
            throw InputError(fmt::format("the frame shows more than {} objects", mostSurfaces));
          lastNumber = found->second;
        }
      }
      result.plane(x, y) = lastNumber;
    }
  return result;
}

}  // namespace kagefude
