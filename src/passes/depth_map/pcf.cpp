#include "passes/depth_map/pcf.h"

#include <algorithm>
#include <vector>

#include "image/parallel.h"
#include "passes/depth_map/map_taps.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr float largestRadius = 1024.0f;

class Pcf {
 public:
  Pcf(const ShadowMap& map, const PcfParams& params, const DepthPyramid* pyramid)
      : map_(map),
        params_(params),
        pyramid_(pyramid),
        projector_(map),
        points_(spiralPoints(params.samples)) {}

  void row(Vec3View position, Vec3View normal, View<const uint32_t> labels, int y,
           float* visibility) const {
    MapReceivers receivers;
    for (int x = 0; x < labels.width; x += MapReceivers::capacity) {
      const int count = std::min(MapReceivers::capacity, labels.width - x);
      projector_.receive(position, normal, labels, x, y, count, receivers);
      if (pyramid_) settleByPyramid(*pyramid_, map_.depth, testFor(receivers), true, receivers);
      receivers.storeKnown(visibility);
      if (receivers.count > 0) storeTaps(receivers, y, visibility);
    }
  }

 private:
  TapTest testFor(const MapReceivers& receivers) const {
    TapTest test;
    test.slopeBias = params_.slope_bias;
    test.spreadBias = params_.spread_bias;
    test.setBias(receivers, params_.bias);
    for (int i = 0; i < receivers.count; ++i)
      test.radius[i] =
          std::min(params_.radius + params_.size * receivers.texelsPerUnit[i], largestRadius);
    return test;
  }

  void storeTaps(const MapReceivers& receivers, int y, float* visibility) const {
    TapCounts counts;
    countTaps(map_.depth, receivers, points_, TapTurns(receivers, y, params_.seed),
              testFor(receivers), counts);
    for (int i = 0; i < receivers.count; ++i)
      visibility[receivers.column[i]] = static_cast<float>(params_.samples - counts.blocked[i]) /
                                        static_cast<float>(params_.samples);
  }

  const ShadowMap& map_;
  const PcfParams& params_;
  const DepthPyramid* pyramid_;
  MapProjector projector_;
  std::vector<V2f> points_;
};

Floats visibilityOf(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                    const Pcf& pcf) {
  Floats visibility(labels.width, labels.height);
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y) pcf.row(position, normal, labels, y, visibility.row(y));
  });
  return visibility;
}

void requireInputs(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                   const ShadowMap& map) {
  if (map.depth.empty()) throw InputError("the light's depth map is empty");
  requireSize("the position pass", position, labels.width, labels.height);
  if (!normal.empty()) requireSize("the normal pass", normal, labels.width, labels.height);
}

}  // namespace

Floats pcfVisibility(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                     const ShadowMap& map, const PcfParams& params) {
  requireInputs(position, normal, labels, map);
  const DepthPyramid pyramid(map.depth);
  return visibilityOf(position, normal, labels, Pcf(map, params, &pyramid));
}

Floats detail::pcfVisibilityByTaps(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                                   const ShadowMap& map, const PcfParams& params) {
  requireInputs(position, normal, labels, map);
  return visibilityOf(position, normal, labels, Pcf(map, params, nullptr));
}

}  // namespace kagefude
