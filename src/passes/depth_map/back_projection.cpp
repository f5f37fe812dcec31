#include "passes/depth_map/back_projection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "image/parallel.h"
#include "passes/depth_map/depth_pyramid.h"
#include "passes/depth_map/light_points.h"
#include "passes/depth_map/map_receiver.h"
#include "passes/depth_map/map_shadow.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr float largestStretch = 4.0f;  ///< of a sphere's outline, seen from the side

struct Receivers {
  Vec3View position, normal;
  View<const uint32_t> labels;
  View<const uint8_t> wanted;

  bool wants(int x, int y) const {
    return labels(x, y) != 0 && (wanted.empty() || wanted(x, y) != 0);
  }
};

struct PixelAnswer {
  float visibility = 1;
  uint8_t contradicted = 0;
};

class BackProjector {
 public:
  BackProjector(const ShadowMap& map, float radius, float bias, std::span<const PlacedMask> masks)
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

  /// What the light shows of itself at one pixel.
  PixelAnswer at(const Receivers& in, int x, int y) const {
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

  /// Whether masks disagree at a pixel.
  bool masksDisagree(int x, int y) const {
    for (const PlacedMask& mask : masks_)
      if ((mask.mask(x, y) != 0) != (masks_[0].mask(x, y) != 0)) return true;
    return false;
  }

 private:
  V3f turned(const V3f& direction) const {
    const V3d turned = lightFromWorld_.direction(V3d(direction));
    return V3f(turned);
  }

  MapPoint receiverOf(const MapReceivers& found, const V3f& position, const V3f& normal) const {
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

  /// A sphere's outline on a plane through its centre, seen at an angle, is longer by 1/cosine
  /// away from the plane's foot; taken along the map's axes.
  V2f perRadius(const V3f& place) const {
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
  V2f onLight(const MapPoint& r, const V3f& offset) const {
    const float along = perspective_ ? r.place.z / (r.place.z - offset.z) : 0;
    const float x = perspective_ ? r.place.x + (offset.x - r.place.x) * along : offset.x;
    const float y = perspective_ ? r.place.y + (offset.y - r.place.y) * along : offset.y;
    return {x * r.perRadius.x, -y * r.perRadius.y};
  }

  /// Height of the light's centre over the receiver's tangent plane.
  float heightOf(const MapPoint& r) const {
    return perspective_ ? -r.normal.dot(r.place) : r.normal.z;
  }

  /// Hides what lies below the receiver's horizon, of a disc that faces the receiver.
  void hideBelowHorizon(const MapPoint& r, HiddenPoints& hidden) const {
    const float height = heightOf(r);
    const float length2 = perspective_ ? r.place.dot(r.place) : 1.0f;
    const float rise = radius_ * std::sqrt(std::max(0.0f, 1 - height * height / length2));
    if (height > rise) return;
    const float aside = std::sqrt(r.normal.x * r.normal.x + r.normal.y * r.normal.y);
    const float per = aside > 0 ? rise / aside : 0;
    points_.hideBelow(height, V2f(r.normal.x * per, -r.normal.y * per), hidden);
  }

  /// What the map says of the masks' places, seen from one receiver.
  struct Masks {
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

  View<const float> depth_;
  bool perspective_;
  Transform lightFromWorld_;
  float radius_, bias_;
  std::span<const PlacedMask> masks_;
  std::vector<V3f> offsets_;
  MapProjector projector_;
  DepthPyramid pyramid_;
  LightPoints points_;
};

constexpr int step = 4;                         ///< of the sparse answers of large frames, pixels
constexpr size_t largeFrame = size_t{1} << 18;  ///< pixels
constexpr float sameShade = 0.1f;               ///< spread of corners between which is interpolated

/// Answers at every fourth pixel of every fourth row, for large frames: a penumbra that is wide
/// there is interpolated between them.
class SparseAnswers {
 public:
  SparseAnswers(const BackProjector& projector, const Receivers& in)
      : projector_(projector),
        in_(in),
        answers_((in.labels.width - 1) / step + 1, (in.labels.height - 1) / step + 1),
        known_(answers_.width(), answers_.height(), uint8_t{0}) {
    parallelRows(answers_.height(), 4, [&](int y0, int y1) {
      for (int j = y0; j < y1; ++j)
        for (int i = 0; i < answers_.width(); ++i)
          if (isNear(i * step, j * step)) {
            answers_(i, j) = projector.at(in, i * step, j * step);
            known_(i, j) = 1;
          }
    });
  }

  PixelAnswer at(int x, int y) const {
    const int i = x / step, j = y / step;
    if (x % step == 0 && y % step == 0) return answers_(i, j);
    if (i + 1 >= answers_.width() || j + 1 >= answers_.height()) return projector_.at(in_, x, y);
    const PixelAnswer* const corners[] = {&answers_(i, j), &answers_(i + 1, j), &answers_(i, j + 1),
                                          &answers_(i + 1, j + 1)};
    float least = 1, most = 0;
    bool same = true;
    for (int k = 0; k < 4; ++k) {
      const int column = i + k % 2, row = j + k / 2;
      same =
          same && known_(column, row) && in_.labels(column * step, row * step) == in_.labels(x, y);
      least = std::min(least, corners[k]->visibility);
      most = std::max(most, corners[k]->visibility);
    }
    const bool flat = least == most && (least == 0 || least == 1);
    if (!same || most - least > sameShade || (flat && projector_.masksDisagree(x, y)))
      return projector_.at(in_, x, y);
    const float across = static_cast<float>(x % step) / step;
    const float down = static_cast<float>(y % step) / step;
    const auto mix = [&](const auto& of) {
      const float upper = of(*corners[0]) + (of(*corners[1]) - of(*corners[0])) * across;
      const float lower = of(*corners[2]) + (of(*corners[3]) - of(*corners[2])) * across;
      return upper + (lower - upper) * down;
    };
    return {
        mix([](const PixelAnswer& a) { return a.visibility; }),
        static_cast<uint8_t>(
            mix([](const PixelAnswer& a) { return static_cast<float>(a.contradicted); }) + 0.5f)};
  }

 private:
  /// Whether a pixel of the cells around wants an answer.
  bool isNear(int x, int y) const {
    if (in_.labels(x, y) == 0) return false;
    for (int row = std::max(0, y - step + 1); row < std::min(in_.labels.height, y + step); ++row)
      for (int column = std::max(0, x - step + 1); column < std::min(in_.labels.width, x + step);
           ++column)
        if (in_.wants(column, row)) return true;
    return false;
  }

  const BackProjector& projector_;
  const Receivers& in_;
  Plane<PixelAnswer> answers_;
  Bytes known_;
};

}  // namespace

BackProjection backProject(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                           const ShadowMap& map, float lightRadius, float bias,
                           std::span<const PlacedMask> masks, View<const uint8_t> wanted) {
  const int width = labels.width, height = labels.height;
  if (map.depth.empty()) throw InputError("the light's depth map is empty");
  if (masks.size() > mostMasks)
    throw InputError(
        fmt::format("a light has at most {} shadow masks, not {}", mostMasks, masks.size()));
  requireSize("the position pass", position, width, height);
  requireSize("the normal pass", normal, width, height);
  for (const PlacedMask& mask : masks) requireSize("a mask", mask.mask, width, height);
  if (!wanted.empty()) requireSize("the wanted pixels", wanted, width, height);
  const BackProjector projector(map, lightRadius, bias, masks);
  const Receivers in{position, normal, labels, wanted};
  std::optional<SparseAnswers> sparse;
  if (labels.pixels() > largeFrame) sparse.emplace(projector, in);
  BackProjection result{Floats(width, height, 1.0f), Bytes(width, height, uint8_t{0})};
  parallelRows(height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < width; ++x) {
        if (!in.wants(x, y)) continue;
        const PixelAnswer answer = sparse ? sparse->at(x, y) : projector.at(in, x, y);
        result.visibility(x, y) = answer.visibility;
        result.contradicted(x, y) = answer.contradicted;
      }
  });
  return result;
}

}  // namespace kagefude
