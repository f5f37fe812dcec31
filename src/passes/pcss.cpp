#include "passes/pcss.h"

#include <cmath>
#include <optional>

#include "image/parallel.h"
#include "passes/depth_pyramid.h"
#include "passes/map_taps.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr float largestRadius = 512.0f;

class Pcss {
 public:
  Pcss(const ShadowMap& map, float lightRadius, const PcssParams& params)
      : map_(map),
        params_(params),
        lightRadius_(lightRadius * params.lightSize),
        pyramid_(map.depth),
        nearest_(pyramid_.range(0, 0, map.depth.width - 1, map.depth.height - 1).nearest),
        search_(spiralPoints(params.search)),
        filter_(spiralPoints(params.samples)) {}

  float at(int x, int y, const V3f& position, const V3f& normal) const {
    const std::optional<MapReceiver> r = receiveOnMap(map_, position, normal);
    if (!r) return 1.0f;
    if (r->turnedAway) return 0.0f;
    TapTest test{radiusFor(*r, nearest_),
                 params_.bias / r->texelsPerUnit + 2e-6f * std::fabs(r->depth), params_.slopeBias,
                 params_.spreadBias};
    if (nothingBefore(*r, test)) return 1.0f;
    const SinCos turn = sinCosTurns(pixelTurn(x, y, params_.seed));
    const TapCount found = countTaps(map_.depth, *r, search_, turn, test);
    if (found.blocked == 0) return 1.0f;
    test.radius = radiusFor(*r, found.blockerDepth / static_cast<float>(found.blocked));
    const TapCount count = countTaps(map_.depth, *r, filter_, turn, test);
    return static_cast<float>(count.lit) / static_cast<float>(filter_.size());
  }

 private:
  /// Texels that the light's disc covers, seen from the receiver through a blocker of that depth.
  float radiusFor(const MapReceiver& r, float blocker) const {
    const float between = std::max(0.0f, r.depth - blocker);
    const float world =
        lightRadius_ * (r.perspective ? between / std::max(blocker, 1e-6f) : between);
    return std::min(world * r.texelsPerUnit, largestRadius);
  }

  bool nothingBefore(const MapReceiver& r, const TapTest& test) const {
    const float reach = test.radius + 1.0f;
    const auto texel = [](float v) { return static_cast<int>(std::floor(v)); };
    const int x0 = texel(r.u - reach), x1 = texel(r.u + reach);
    const int y0 = texel(r.v - reach), y1 = texel(r.v + reach);
    if (x1 < 0 || y1 < 0 || x0 >= map_.depth.width || y0 >= map_.depth.height) return true;
    return r.planeDepthBounds(reach, test.slopeBias).high - test.bias <=
           pyramid_.range(x0, y0, x1, y1).nearest;
  }

  const ShadowMap& map_;
  const PcssParams& params_;
  float lightRadius_;
  DepthPyramid pyramid_;
  float nearest_;
  std::vector<V2f> search_, filter_;
};

}  // namespace

Floats pcssVisibility(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                      const ShadowMap& map, float lightRadius, const PcssParams& params) {
  if (map.depth.empty()) throw InputError("the light's depth map is empty");
  requireSize("the position pass", position, labels.width, labels.height);
  if (!normal.empty()) requireSize("the normal pass", normal, labels.width, labels.height);
  const Pcss pcss(map, lightRadius, params);
  Floats visibility(labels.width, labels.height);
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < labels.width; ++x)
        visibility(x, y) =
            labels(x, y) == 0
                ? 1.0f
                : pcss.at(x, y, position(x, y), normal.empty() ? V3f(0, 0, 0) : normal(x, y));
  });
  return visibility;
}

}  // namespace kagefude
