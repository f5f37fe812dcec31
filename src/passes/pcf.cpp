#include "passes/pcf.h"

#include <cmath>
#include <optional>
#include <vector>

#include "image/parallel.h"
#include "passes/depth_pyramid.h"
#include "passes/map_taps.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr float largestRadius = 1024.0f;

class Pcf {
 public:
  Pcf(const ShadowMap& map, const PcfParams& params, const DepthPyramid* pyramid)
      : map_(map), params_(params), pyramid_(pyramid), points_(spiralPoints(params.samples)) {}

  float at(int x, int y, const V3f& position, const V3f& normal) const {
    const std::optional<MapReceiver> r = receiveOnMap(map_, position, normal);
    if (!r) return 1.0f;
    if (r->turnedAway) return 0.0f;
    const float radius = std::min(params_.radius + params_.size * r->texelsPerUnit, largestRadius);
    const float bias = params_.bias / r->texelsPerUnit + 2e-6f * std::fabs(r->depth);
    if (pyramid_) {
      const std::optional<float> settled = settle(*r, radius, bias);
      if (settled) return *settled;
    }
    return taps(*r, radius, bias, sinCosTurns(pixelTurn(x, y, params_.seed)));
  }

 private:
  /// The answer where all taps agree for certain.
  std::optional<float> settle(const MapReceiver& r, float radius, float bias) const {
    const float reach = radius + 1.0f;
    const auto floorOf = [](float v) { return static_cast<int>(std::floor(v)); };
    const int x0 = floorOf(r.u - reach), x1 = floorOf(r.u + reach);
    const int y0 = floorOf(r.v - reach), y1 = floorOf(r.v + reach);
    const View<const float>& depth = map_.depth;
    if (x1 < 0 || y1 < 0 || x0 >= depth.width || y0 >= depth.height) return 1.0f;
    const DepthRange stored = pyramid_->range(x0, y0, x1, y1);
    const MapReceiver::Bounds plane = r.planeDepthBounds(reach, params_.slope_bias);
    if (plane.high - bias <= stored.nearest) return 1.0f;
    const bool inside = x0 >= 0 && y0 >= 0 && x1 < depth.width && y1 < depth.height;
    const float widest = 1.4143f * reach * params_.spread_bias / r.texelsPerUnit;
    if (inside && plane.low - bias - widest > stored.farthest) return 0.0f;
    return std::nullopt;
  }

  float taps(const MapReceiver& r, float radius, float bias, SinCos turn) const {
    const TapCount count = countTaps(map_.depth, r, points_, turn,
                                     {radius, bias, params_.slope_bias, params_.spread_bias});
    return static_cast<float>(count.lit) / static_cast<float>(points_.size());
  }

  const ShadowMap& map_;
  const PcfParams& params_;
  const DepthPyramid* pyramid_;
  std::vector<V2f> points_;
};

Floats visibilityOf(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                    const Pcf& pcf) {
  Floats visibility(labels.width, labels.height);
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < labels.width; ++x)
        visibility(x, y) = labels(x, y) == 0 ? 1.0f
                                             : pcf.at(x, y, position(x, y),
                                                      normal.empty() ? V3f(0, 0, 0) : normal(x, y));
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
