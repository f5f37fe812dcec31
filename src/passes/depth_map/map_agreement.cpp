#include "passes/depth_map/map_agreement.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "passes/depth_map/map_receiver.h"
#include "passes/require_size.h"
#include "passes/tone/lambert.h"

namespace kagefude {
namespace {

constexpr double places = 4096;
constexpr float leastFacing = 0.2f;  ///< cosine between the normal and the way to the light
constexpr float tolerance = 4;       ///< texel widths on the surface
constexpr size_t enough = 64;        ///< pixels of a kind
// Of 20 exported scenes the least were 0.71 (leaves) and 0.998; of a map mirrored, turned or scaled
// by a twentieth at least one is below.
constexpr double leastHidden = 0.4, leastLit = 0.95;
// Of a dozen of these the least was 0.994; of a map turned by a quarter 0.007.
constexpr double leastOwn = 0.02;

double share(size_t part, size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

bool areAlike(std::span<const View<const uint8_t>> masks, int x, int y) {
  const bool first = masks.front()(x, y) != 0;
  return std::all_of(masks.begin(), masks.end(),
                     [&](const View<const uint8_t>& mask) { return (mask(x, y) != 0) == first; });
}

/// Left at the first texel that holds something: of a map that does, that is soon.
bool isEmpty(View<const float> depth) {
  constexpr float nothing = 1e9f;
  for (int y = 0; y < depth.height; ++y)
    if (std::any_of(depth.row(y), depth.row(y) + depth.width,
                    [](float texel) { return texel < nothing; }))
      return false;
  return true;
}

enum class InMap { outside, hidden, itself, past };

/// What the map shows at its lane 0: something before it, the place itself, or what lies behind.
InMap placeInMap(const View<const float>& depth, const MapReceivers& found, float cosine) {
  const float u = found.u[0], v = found.v[0];
  if (found.visibility[0] != MapReceivers::open || !(u >= 0) || !(v >= 0) ||
      !(u < static_cast<float>(depth.width)) || !(v < static_cast<float>(depth.height)))
    return InMap::outside;
  const float margin = tolerance / (found.texelsPerUnit[0] * cosine);
  const float texel = depth(static_cast<int>(u), static_cast<int>(v));
  if (texel < found.depth[0] - margin) return InMap::hidden;
  return texel <= found.depth[0] + margin ? InMap::itself : InMap::past;
}

void countLit(InMap place, MapAgreement& result) {
  ++result.lit;
  result.litInMap += place != InMap::hidden;
  result.litInside += place != InMap::outside;
  result.litOwn += place == InMap::itself;
}

}  // namespace

bool MapAgreement::emptyThoughHidden() const { return mapEmpty && hidden + partly >= enough; }

bool MapAgreement::seesPastLit() const {
  return hidden < enough && !mapEmpty && litInside >= enough && share(litOwn, litInside) < leastOwn;
}

bool MapAgreement::contradicts() const {
  return (hidden >= enough && share(hiddenInMap, hidden) < leastHidden) ||
         (lit >= enough && share(litInMap, lit) < leastLit) || emptyThoughHidden() || seesPastLit();
}

MapAgreement agreementOf(std::span<const View<const uint8_t>> masks, const Light& light,
                         Vec3View position, Vec3View normal, View<const uint32_t> labels,
                         const ShadowMap& map) {
  const int width = labels.width, height = labels.height;
  if (map.depth.empty()) throw InputError("the light's depth map is empty");
  requireSize("the position pass", position, width, height);
  requireSize("the normal pass", normal, width, height);
  for (const View<const uint8_t>& mask : masks) requireSize("a mask", mask, width, height);
  MapAgreement result;
  if (masks.empty()) return result;
  result.mapEmpty = isEmpty(map.depth);
  const MapProjector projector(map);
  const int stride =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(labels.pixels()) / places)));
  MapReceivers found;
  for (int y = stride / 2; y < height; y += stride)
    for (int x = stride / 2; x < width; x += stride) {
      if (labels(x, y) == 0) continue;
      const float cosine = normal(x, y).dot(towardsLight(light, position(x, y)));
      if (!(cosine >= leastFacing)) continue;
      if (!areAlike(masks, x, y)) {
        ++result.partly;
        continue;
      }
      projector.receive(position, normal, labels, x, y, 1, found);
      const InMap place = placeInMap(map.depth, found, cosine);
      if (masks.front()(x, y) == 0) {
        ++result.hidden;
        result.hiddenInMap += place == InMap::hidden;
      } else {
        countLit(place, result);
      }
    }
  return result;
}

}  // namespace kagefude
