#pragma once

#include <algorithm>
#include <array>

#include "passes/casters/coverage.h"
#include "passes/casters/pixel_boxes.h"

namespace kagefude {

/// Lists up to this length are tested pixel by pixel at once rather than cut down further.
inline constexpr int shortList = 48;
/// A rectangle's quarters descend the tree anew rather than read a list that is longer than this:
/// where few pixels are shown of much, most of the list is apart from most of them.
inline constexpr int longList = 128;
/// Rounding of a point relative to its distance from the eye, with some to spare.
inline constexpr float roundingBias = 4e-6f;

/// How far points are lifted off their surface, in world units.
inline float biasOf(float pixelSize, float reach, const CoverageParams& params) {
  return params.bias * pixelSize + roundingBias * reach;
}

inline PointBox fromApex(PointBox box, const V3f& apex) {
  box.centre -= apex;
  return box;
}

/// A square of pixels of a tile.
struct Rect {
  int x0, y0, x1, y1;

  int width() const { return x1 - x0; }
  Rect quarter(int k) const {
    const int half = width() / 2, x = x0 + (k % 2) * half, y = y0 + (k / 2) * half;
    return {x, y, x + half, y + half};
  }
};

/// Descends the tree for a tile, or for its quarters where much is in reach of it, and cuts it in
/// four, with ever shorter lists, until a rectangle is uniform or its list is short.
class TileShader {
 public:
  TileShader(const SeenSurface& surface, const ShadowWedges& wedges, const CoverageParams& params)
      : surface_(surface), wedges_(wedges), params_(params) {}

 protected:
  /// `settle(rect, shaded)` takes uniform rectangles, `leaf(rect, list)` the others.
  template <class Settle, class Leaf>
  void shade(const PixelBoxes& boxes, const Rect& rect, const Settle& settle, const Leaf& leaf) {
    const auto quarters = [&] {
      for (int k = 0; k < 4; ++k) shade(boxes, rect.quarter(k), settle, leaf);
    };
    if (rect.width() == coverageTile) widest_ = std::min(2 * widest_, coverageTile);
    PointBox box;
    bool stretched;
    if (!boxes.around(rect.x0, rect.y0, rect.x1, rect.y1, box, stretched)) return;
    if (rect.width() > widest_ || (stretched && rect.width() > 1)) return quarters();
    const BoxState state = wedges_.gather(box, verdictBias(boxes), list_);
    if (state == BoxState::touching && list_.count > longList && rect.width() > 1) {
      widest_ = rect.width() / 2;
      quarters();
    } else if (state == BoxState::touching)
      refine(boxes, rect, list_, 0, settle, leaf);
    else
      settle(rect, state == BoxState::inside);
  }

  /// With the receiver left out, whether a wedge counts depends on the sub-pixel's object, so that
  /// nothing larger can be judged.
  float verdictBias(const PixelBoxes& boxes) const {
    return params_.selfShadow ? biasOf(boxes.pixelSize(), boxes.reach(), params_) : undecided;
  }
  bool counts(uint32_t casterId, uint32_t receiverId) const {
    return params_.selfShadow || casterId == 0 || casterId != receiverId;
  }

  const SeenSurface& surface_;
  const ShadowWedges& wedges_;
  const CoverageParams& params_;

 private:
  template <class Settle, class Leaf>
  void refine(const PixelBoxes& boxes, const Rect& rect, const WedgeList& list, int level,
              const Settle& settle, const Leaf& leaf) {
    if (rect.width() == 1 || list.count <= shortList) {
      leaf(rect, list);
      return;
    }
    for (int k = 0; k < 4; ++k) {
      const Rect part = rect.quarter(k);
      PointBox box;
      bool stretched;
      if (!boxes.around(part.x0, part.y0, part.x1, part.y1, box, stretched)) continue;
      WedgeList& kept = levels_[level];
      const BoxState state =
          filterWedges(list, fromApex(box, wedges_.apex()), verdictBias(boxes), kept);
      if (state == BoxState::touching)
        refine(boxes, part, kept, level + 1, settle, leaf);
      else
        settle(part, state == BoxState::inside);
    }
  }

  WedgeList list_;
  /// Of the rectangles whose lists were not long lately, for neighbours' are alike.
  int widest_ = coverageTile;
  std::array<WedgeList, 4> levels_;
};

/// Tiles in so many pixels, the last one perhaps cut.
inline int tiles(int pixels) { return (pixels + coverageTile - 1) / coverageTile; }

}  // namespace kagefude
