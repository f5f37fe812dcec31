#include "passes/depth_map/back_projector.h"

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

constexpr float largestStretch = 4.0f;  ///< of a sphere's outline, seen from the side

}  // namespace

/// What the map says of the masks' places, seen from one receiver.
struct BackProjector::Masks {
  Masks(const BackProjector& projector, const MapPoint& r) : masks(projector.masks_) {
    const float height = projector.heightOf(r);
    for (size_t k = 0; k < masks.size(); ++k) {
      places[k] = projector.onLight(r, projector.offsets_[k]);
      hidden[k] = !(height + r.normal.dot(projector.offsets_[k]) > 0);
      if (!hidden[k]) open[opened++] = k;
      extent = std::max({extent, std::fabs(places[k].x), std::fabs(places[k].y)});
    }
  }
  void hide(const LightRectangle& rectangle) {
    for (size_t i = 0; i < opened;) {
      const size_t k = open[i];
      if (rectangle.holds(places[k])) {
        hidden[k] = true;
        open[i] = open[--opened];
      } else {
        ++i;
      }
    }
  }
  /// The whole light is hidden; places on its rim count as its.
  void hideLight() {
    for (size_t k = 0; k < masks.size(); ++k)
      hidden[k] = hidden[k] || places[k].dot(places[k]) < 1.1f;
  }
  uint8_t contradicted(int x, int y) const {
    uint8_t number = 0;
    for (size_t k = 0; k < masks.size(); ++k) number += hidden[k] == (masks[k].mask(x, y) != 0);
    return number;
  }

  std::span<const PlacedMask> masks;
  float extent = 1;
  V2f places[mostMasks];
  bool hidden[mostMasks];
  size_t open[mostMasks];  ///< those that nothing has hidden yet
  size_t opened = 0;
};

BackProjector::BackProjector(const ShadowMap& map, float radius, float bias,
                             std::span<const PlacedMask> masks)
    : depth_(map.depth),
      perspective_(map.clipFromLight.m[3][2] != 0),
      lightFromWorld_(map.lightFromWorld),
      radius_(radius),
      bias_(bias),
      masks_(masks),
      projector_(map),
      pyramid_(map.depth) {
  for (const PlacedMask& mask : masks) offsets_.push_back(turned(mask.offset));
}

PixelAnswer BackProjector::at(const Receivers& in, int x, int y) const {
  MapReceivers found;
  projector_.receive(in.position, in.normal, in.labels, x, y, 1, found);
  if (found.visibility[0] == 1.0f) return {};
  const MapPoint r = receiverOf(found, in.position(x, y), in.normal(x, y));
  HiddenPoints hidden;
  hideBelowHorizon(r, hidden);
  Masks seen(*this, r);
  const MapShadow shadow(depth_, pyramid_, perspective_, r, bias_, seen.extent);
  if (!hidden.all())
    shadow.eachRectangle([&](const LightRectangle& rectangle) {
      points_.hideRectangle(rectangle.x0, rectangle.x1, rectangle.y0, rectangle.y1, hidden);
      seen.hide(rectangle);
      return !hidden.all();
    });
  if (hidden.all()) seen.hideLight();
  return {static_cast<float>(LightPoints::size - hidden.count()) / LightPoints::size,
          seen.contradicted(x, y)};
}

bool BackProjector::masksDisagree(int x, int y) const {
  for (const PlacedMask& mask : masks_)
    if ((mask.mask(x, y) != 0) != (masks_[0].mask(x, y) != 0)) return true;
  return false;
}

V3f BackProjector::turned(const V3f& direction) const {
  const V3d turned = lightFromWorld_.direction(V3d(direction));
  return V3f(turned);
}

MapPoint BackProjector::receiverOf(const MapReceivers& found, const V3f& position,
                                   const V3f& normal) const {
  MapPoint r;
  r.place = V3f(lightFromWorld_.point(V3d(position)));
  r.normal = turned(normal);
  r.u = found.u[0];
  r.v = found.v[0];
  r.depth = found.depth[0];
  r.texelsPerUnit = found.texelsPerUnit[0];
  r.texelsPerSlope = perspective_ ? r.texelsPerUnit * r.depth : r.texelsPerUnit;
  r.perRadius = perRadius(r.place);
  return r;
}

/// A sphere's outline on a plane through its centre, seen at an angle, is longer by 1/cosine away
/// from the plane's foot; taken along the map's axes.
V2f BackProjector::perRadius(const V3f& place) const {
  const float radius = std::max(radius_, 1e-6f * std::fabs(place.z));
  if (!perspective_) return {1 / radius, 1 / radius};
  const float aside = place.x * place.x + place.y * place.y;
  if (!(aside > 0)) return {1 / radius, 1 / radius};
  const float stretch =
      std::min(largestStretch, std::sqrt(aside + place.z * place.z) / std::fabs(place.z));
  const float more = (stretch - 1) / aside;
  return {1 / (radius * (1 + more * place.x * place.x)),
          1 / (radius * (1 + more * place.y * place.y))};
}

/// Place on the light's disc of a mask's place, seen from the receiver.
V2f BackProjector::onLight(const MapPoint& r, const V3f& offset) const {
  const float along = perspective_ ? r.place.z / (r.place.z - offset.z) : 0;
  const float x = perspective_ ? r.place.x + (offset.x - r.place.x) * along : offset.x;
  const float y = perspective_ ? r.place.y + (offset.y - r.place.y) * along : offset.y;
  return {x * r.perRadius.x, -y * r.perRadius.y};
}

/// Height of the light's centre over the receiver's tangent plane.
float BackProjector::heightOf(const MapPoint& r) const {
  return perspective_ ? -r.normal.dot(r.place) : r.normal.z;
}

/// Hides what lies below the receiver's horizon, of a disc that faces the receiver.
void BackProjector::hideBelowHorizon(const MapPoint& r, HiddenPoints& hidden) const {
  const float height = heightOf(r);
  const float length2 = perspective_ ? r.place.dot(r.place) : 1.0f;
  const float rise = radius_ * std::sqrt(std::max(0.0f, 1 - height * height / length2));
  if (height > rise) return;
  const float aside = std::sqrt(r.normal.x * r.normal.x + r.normal.y * r.normal.y);
  const float per = aside > 0 ? rise / aside : 0;
  points_.hideBelow(height, V2f(r.normal.x * per, -r.normal.y * per), hidden);
}

}  // namespace kagefude
