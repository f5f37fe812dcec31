#include "passes/light_shape/horizon.h"

#include <cmath>

#include "image/parallel.h"
#include "passes/light_shape/light_share.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

/// Heights of a disc of the same radius that faces the receiver, as a sphere is seen from there:
/// the masks' disc faces the subject, and over other receivers it stands less high.
void turnToReceiver(const LightGeometry& geometry, const V3f& n, const V3f& towards, float middle,
                    std::span<float> height) {
  const float u = n.dot(geometry.u), v = n.dot(geometry.v);
  const float sine2 = 1.0f - middle * middle / towards.dot(towards);
  const float slope2 = u * u + v * v;
  if (!(sine2 > 0) || !(slope2 > 0)) return;
  const float stretch = std::sqrt(geometry.u.dot(geometry.u) * sine2 / slope2);
  for (float& h : height) h = middle + (h - middle) * stretch;
}

}  // namespace

bool Horizon::explains(std::span<const View<const uint8_t>> masks, int x, int y,
                       float* height) const {
  const V3f n = normal_(x, y);
  const V3f towards = geometry_.sun ? -geometry_.direction : geometry_.position - position_(x, y);
  const float middle = n.dot(towards);
  const float u = n.dot(geometry_.u), v = n.dot(geometry_.v);
  // Wholly above the horizon: it hides nothing. Places reach a little beyond 1 for rounding.
  if (middle > 1.5f * (std::fabs(u) + std::fabs(v))) return false;
  for (size_t k = 0; k < masks.size(); ++k) {
    height[k] = middle + u * places_[k].x + v * places_[k].y;
    if ((height[k] > 0) != (masks[k](x, y) != 0)) return false;
  }
  if (geometry_.sphere)
    turnToReceiver(geometry_, n, towards, middle, std::span(height, masks.size()));
  return true;
}

void settleAtHorizon(View<const uint8_t> farMask, View<const uint8_t> nearMask,
                     View<const uint32_t> labels, Vec3View position, Vec3View normal,
                     const PairLight& light, View<float> visibility) {
  requireSize("the position pass", position, labels.width, labels.height);
  requireSize("the normal pass", normal, labels.width, labels.height);
  if (!(light.radius > 0)) return;
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < labels.width; ++x) {
        if (labels(x, y) == 0 || (farMask(x, y) != 0) == (nearMask(x, y) != 0)) continue;
        const V3f n = normal(x, y), towards = light.position - position(x, y);
        const float middle = n.dot(towards), rise = n.dot(light.towardsFar);
        const bool seen = (middle + rise > 0) == (farMask(x, y) != 0) &&
                          (middle - rise > 0) == (nearMask(x, y) != 0);
        const float sine2 = 1.0f - middle * middle / towards.dot(towards);
        if (seen && sine2 > 0)
          visibility(x, y) = discShare(middle / (light.radius * std::sqrt(sine2)));
      }
  });
}

}  // namespace kagefude
