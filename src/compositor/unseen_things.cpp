#include "compositor/unseen_things.h"

#include <map>
#include <set>

namespace kagefude {
namespace {

constexpr double fewestPixels = 16.0;

/// Names by the Cryptomatte's ids.
std::map<uint32_t, std::string> namesOfCovering(const FramePlan& plan) {
  std::map<uint32_t, std::string> names;
  for (const auto& [id, name] : plan.objectNames)
    if (const uint32_t crypto = plan.cryptomatteIdOf(id)) names.emplace(crypto, name);
  return names;
}

}  // namespace

std::vector<std::string> unseenThings(const FramePlan& plan, const FramePlanes& planes) {
  if (planes.coverageIds.empty()) return {};
  std::set<uint32_t> seen;
  std::map<uint32_t, double> covered;
  uint32_t object = 0, own = 0;
  for (int y = 0; y < planes.height; ++y)
    for (int x = 0; x < planes.width; ++x) {
      const uint32_t here = planes.objectId(x, y);
      if (here != object) {
        object = here;
        own = here ? plan.cryptomatteIdOf(here) : 0;
        seen.insert(own);
      }
      for (size_t rank = 0; rank < planes.coverageIds.size(); ++rank) {
        const uint32_t id = planes.coverageIds[rank](x, y);
        const float share = planes.coverageShares[rank](x, y);
        if (id != 0 && id != own && share > 0.0f) covered[id] += double{share};
        if (!(share < 1.0f)) break;
      }
    }
  std::set<std::string> names;
  const std::map<uint32_t, std::string> known = namesOfCovering(plan);
  for (const auto& [id, pixels] : covered)
    if (pixels >= fewestPixels && !seen.count(id) && known.count(id)) names.insert(known.at(id));
  return {names.begin(), names.end()};
}

}  // namespace kagefude
