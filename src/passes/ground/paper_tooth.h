#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "image/vec.h"
#include "passes/brush/brush_anchor.h"
#include "passes/casters/camera_rays.h"
#include "passes/ground/tooth_tile.h"

namespace kagefude {

/// The paper's surface, a value a pixel.
struct PaperTooth {
  Floats height;  ///< 0..1, as ToothSample
  Floats slope;
};

/// The paper's surface at some pixels of a row.
struct ToothRun {
  static constexpr int most = 256;
  float height[most], slope[most];
};

/// The paper under a picture: a tooth with a value a pixel, or one that stands still on the screen
/// and is read from its tile, texel by texel.
class PaperSurface {
 public:
  /// No paper.
  PaperSurface() = default;
  explicit PaperSurface(PaperTooth tooth) : tooth_(std::move(tooth)) {}
  /// (offsetX, offsetY): the picture's first pixel, counted from the display window's corner, so
  /// that a crop shows the same paper.
  PaperSurface(ToothTile tile, int offsetX, int offsetY)
      : tile_(std::move(tile)), offsetX_(offsetX), offsetY_(offsetY) {}

  bool empty() const { return !tile_ && tooth_.height.empty(); }
  /// Of the `count` pixels from (x, y) to the right, at most ToothRun::most. Not of no paper.
  void read(int x, int y, int count, ToothRun& run) const;

 private:
  PaperTooth tooth_;
  std::optional<ToothTile> tile_;
  int offsetX_ = 0, offsetY_ = 0;
};

/// What the tooth lies on where it is fixed to the world.
struct ToothPlaces {
  Vec3View position, normal;         ///< world
  Vec3View rest;                     ///< places at rest, may be empty (see applyBrush)
  View<const uint16_t> anchorIndex;  ///< 0 = background, i -> anchors[i - 1]
  std::span<const BrushAnchor> anchors;
  const CameraRays* rays = nullptr;
  bool upIsY = false;  ///< world's up axis; else Z
};

/// **[ours]** Tooth that lies on the world: on objects in the planes of their own axes that the
/// surface faces, at its place as it rests where strokes lie there; on the background by the
/// direction of view. Its size follows the pixel's in octaves of a world unit (a turn, for
/// directions), of which two fade into each other, so that it is about `grain` pixels wide at every
/// depth and nothing slides while the camera moves. Where a surface turns away it is coarser, for
/// the pixel covers more of it. Straight up and down directions run together. Depends on this
/// frame's geometry alone. Cost: two to six lookups a pixel.
PaperTooth worldTooth(const ToothTile& tile, const ToothPlaces& places);

}  // namespace kagefude
