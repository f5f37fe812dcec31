#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/depth_map/back_projection.h"
#include "passes/depth_map/depth_pyramid.h"
#include "passes/depth_map/light_points.h"
#include "passes/depth_map/map_receiver.h"
#include "passes/depth_map/map_shadow.h"

namespace kagefude {

/// What backProject reads of the frame.
struct Receivers {
  Vec3View position, normal;
  View<const uint32_t> labels;
  View<const uint8_t> wanted;
};

/// Of one pixel, as BackProjection's planes.
struct PixelAnswer {
  float visibility = 1;
  uint8_t contradicted = 0;
};

/// Throws a depth map back on a round light, pixel by pixel (back_projection.h). What it is made of
/// must outlive it.
class BackProjector {
 public:
  BackProjector(const ShadowMap& map, float radius, float bias, std::span<const PlacedMask> masks);

  /// What the light shows of itself at one pixel.
  PixelAnswer at(const Receivers& in, int x, int y) const;

  /// Whether masks disagree at a pixel.
  bool masksDisagree(int x, int y) const;

 private:
  struct Masks;

  V3f turned(const V3f& direction) const;
  MapPoint receiverOf(const MapReceivers& found, const V3f& position, const V3f& normal) const;
  V2f perRadius(const V3f& place) const;
  V2f onLight(const MapPoint& r, const V3f& offset) const;
  float heightOf(const MapPoint& r) const;
  void hideBelowHorizon(const MapPoint& r, HiddenPoints& hidden) const;

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

}  // namespace kagefude
