#include "passes/depth_map/pcss.h"

#include <algorithm>
#include <vector>

#include "image/parallel.h"
#include "passes/depth_map/map_taps.h"
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
        projector_(map),
        search_(spiralPoints(params.search)),
        filter_(spiralPoints(params.samples)) {}

  void row(Vec3View position, Vec3View normal, View<const uint32_t> labels, int y,
           float* visibility) const {
    MapReceivers receivers;
    for (int x = 0; x < labels.width; x += MapReceivers::capacity) {
      const int count = std::min(MapReceivers::capacity, labels.width - x);
      projector_.receive(position, normal, labels, x, y, count, receivers);
      settleByPyramid(pyramid_, map_.depth, searchFor(receivers), false, receivers);
      receivers.storeKnown(visibility);
      if (receivers.count == 0) continue;
      findPenumbra(receivers, y);
      for (int i = 0; i < receivers.count; ++i)
        visibility[receivers.column[i]] = receivers.visibility[i];
    }
  }

 private:
  /// Texels that the light's disc covers, seen from a receiver through a blocker of that depth.
  float radiusFor(const MapReceivers& r, int lane, float blocker) const {
    const float between = std::max(0.0f, r.depth[lane] - blocker);
    const float world =
        lightRadius_ * (r.perspective ? between / std::max(blocker, 1e-6f) : between);
    return std::min(world * r.texelsPerUnit[lane], largestRadius);
  }

  TapTest searchFor(const MapReceivers& receivers) const {
    TapTest test;
    test.slopeBias = params_.slopeBias;
    test.spreadBias = params_.spreadBias;
    test.setBias(receivers, params_.bias);
    const float nearest = pyramid_.whole().nearest;
    for (int i = 0; i < receivers.count; ++i) test.radius[i] = radiusFor(receivers, i, nearest);
    return test;
  }

  /// Looks for blockers, then filters over a disc of the size that they call for.
  void findPenumbra(MapReceivers& receivers, int y) const {
    const TapTurns turns(receivers, y, params_.seed);
    TapTest test = searchFor(receivers);
    TapCounts found, counts;
    countTaps(map_.depth, receivers, search_, turns, test, found);
    for (int i = 0; i < receivers.count; ++i)
      test.radius[i] =
          found.blocked[i] == 0
              ? 0.0f
              : radiusFor(receivers, i,
                          found.blockerDepth[i] / static_cast<float>(found.blocked[i]));
    countTaps(map_.depth, receivers, filter_, turns, test, counts);
    for (int i = 0; i < receivers.count; ++i)
      receivers.visibility[i] = found.blocked[i] == 0
                                    ? 1.0f
                                    : static_cast<float>(params_.samples - counts.blocked[i]) /
                                          static_cast<float>(params_.samples);
  }

  const ShadowMap& map_;
  const PcssParams& params_;
  float lightRadius_;
  DepthPyramid pyramid_;
  MapProjector projector_;
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
    for (int y = y0; y < y1; ++y) pcss.row(position, normal, labels, y, visibility.row(y));
  });
  return visibility;
}

}  // namespace kagefude
