#include "compositor/unseen_things.h"

#include <map>
#include <set>

namespace kagefude {
namespace {

constexpr double fewestPixels = 16.0;
constexpr float smallestShare = 1.0f / 512.0f;
constexpr float fullShare = 1.0f - smallestShare;

/// Names by the Cryptomatte's ids, of what is to be painted.
std::map<uint32_t, std::string> namesOfCovering(const FramePlan& plan) {
  std::map<uint32_t, std::string> names;
  for (const auto& [id, name] : plan.objectNames) {
    const SidecarObject* const object = plan.findObject(id);
    if (object && !object->painted) continue;
    if (const uint32_t crypto = plan.cryptomatteIdOf(id)) names.emplace(crypto, name);
  }
  return names;
}

/// Adds what covers a pixel and is not its own thing; ranks fall.
void addForeign(const FramePlanes& planes, int x, int y, uint32_t own,
                std::map<uint32_t, double>& covered) {
  for (size_t rank = 0; rank < planes.coverage.ranks(); ++rank) {
    const uint32_t id = planes.coverage.id(rank, x, y);
    const float share = planes.coverage.share(rank, x, y);
    if (!(share >= smallestShare)) return;
    if (id != 0 && id != own) covered[id] += double{share};
  }
}

}  // namespace

std::vector<std::string> unseenThings(const FramePlan& plan, const FramePlanes& planes) {
  if (planes.coverage.empty()) return {};
  std::set<uint32_t> seen;
  std::map<uint32_t, double> covered;
  uint32_t object = 0, own = 0;
  for (int y = 0; y < planes.height; ++y) {
    const uint32_t* const objects = planes.objectId.row(y);
    const uint32_t* const first = planes.coverage.firstId.row(y);
    const float* const share = planes.coverage.firstShare.row(y);
    for (int x = 0; x < planes.width; ++x) {
      if (objects[x] != object) {
        object = objects[x];
        own = object ? plan.cryptomatteIdOf(object) : 0;
        seen.insert(own);
      }
      if (first[x] != own || !(share[x] >= fullShare)) addForeign(planes, x, y, own, covered);
    }
  }
  std::set<std::string> names;
  const std::map<uint32_t, std::string> known = namesOfCovering(plan);
  for (const auto& [id, pixels] : covered)
    if (pixels >= fewestPixels && !seen.count(id) && known.count(id)) names.insert(known.at(id));
  return {names.begin(), names.end()};
}

}  // namespace kagefude
