#pragma once

#include <vector>

#include "passes/edges/painted_edges.h"

namespace kagefude {

struct PixelAt {
  int x = 0, y = 0;
};

/// The steps to a pixel's four neighbours.
inline constexpr int sideX[4] = {1, -1, 0, 0}, sideY[4] = {0, 0, 1, -1};

/// The borders of a picture whose paint gets its edges (paintEdges): those at which the params of
/// either side do anything.
class EdgeBorders {
 public:
  /// `in` must outlive it.
  explicit EdgeBorders(const EdgePaint& in);

  /// Params of the pixel's thing; of the background and unknown things those that do nothing.
  const PaintedEdgeParams& paramsAt(const PixelAt& at) const {
    return paramsOf(in_.things(at.x, at.y));
  }
  /// Whether a border runs between a pixel of the thing `own` and (x, y); none at the frame's.
  bool isBorder(uint16_t own, int x, int y) const;
  /// Whether a side of the pixel is a border.
  bool isAtBorder(int x, int y) const;
  /// 1 where isAtBorder.
  Bytes borderPixels() const;
  /// Share of a pixel that the thing at `own` covers, by the ranks, which must be there.
  float coveredBy(const PixelAt& own, const PixelAt& at) const;
  /// Whether the thing at `own` is: the nearer one. Where both are equally far, as where one stands
  /// on the other, the smaller in the picture is, all along that border: pixels there would tell it
  /// now of the one and now of the other. Equally far are those that differ by less than twice what
  /// either changes from pixel to pixel.
  bool isInFront(const PixelAt& own, const PixelAt& other) const;

 private:
  const PaintedEdgeParams& paramsOf(uint16_t thing) const {
    return thing == 0 || thing > in_.params.size() ? none_ : in_.params[thing - 1u];
  }
  uint32_t sizeOf(uint16_t thing) const { return thing < sizes_.size() ? sizes_[thing] : 0u; }
  float distanceOf(const PixelAt& at) const;
  float changeOf(const PixelAt& at, const PixelAt& beyond) const;

  const EdgePaint& in_;
  std::vector<uint32_t> sizes_;  ///< pixels of each thing, by its number
  const PaintedEdgeParams none_{};
};

/// 1 in the squares of 32 pixels that lie within `reach` of one that holds a pixel of `borders`,
/// and in some beyond.
Bytes squaresInReach(View<const uint8_t> borders, float reach);

}  // namespace kagefude
