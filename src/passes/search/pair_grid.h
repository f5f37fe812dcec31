#pragma once

#include <functional>
#include <vector>

#include "image/plane.h"

namespace kagefude {

/// The search grid of 000 section 3.3.3: cells of `step` pixels, cut in pieces where asked, with
/// values at the corners of the pieces and bilinear interpolation inside (eq. 3.5-3.7).
class PairGrid {
 public:
  /// classes: ShadowClass bytes. labels: empty for no bound. Both must outlive the grid.
  PairGrid(View<const uint8_t> classes, View<const uint32_t> labels, int step);

  /// Cuts cells into pieces of a quarter of the narrowest penumbra at their corners; width(x, y)
  /// is asked at searched corners. Cells with penumbra but none at a corner get pieces of a pixel.
  void refine(const std::function<float(int x, int y)>& width);

  /// 1 at the penumbra pixels to be searched: corners of pieces that hold penumbra, and penumbra
  /// pixels that no corner of their label reaches; else 0.
  Bytes searched() const;

  /// Value at a pixel from the corners of its piece that are of its label, their weights scaled to
  /// a sum of 1. Only for penumbra pixels that are not searched themselves.
  float interpolate(int x, int y, View<const float> values) const;

 private:
  struct Corner {
    int x, y;
    float weight;
  };
  struct Corners {
    Corner corner[4];
  };
  /// Cut of one axis: the two grid lines round a place, and the share of the upper one (eq. 3.5).
  struct Span {
    int low, high;
    float share;
  };
  Span spanAt(int place, int piece, int size) const;
  Corners cornersAt(int x, int y) const;
  bool sameLabel(int x, int y, int qx, int qy) const;
  int& pieceAt(int x, int y) { return pieces_[cellIndex(x, y)]; }
  int pieceAt(int x, int y) const { return pieces_[cellIndex(x, y)]; }
  size_t cellIndex(int x, int y) const {
    return static_cast<size_t>(y / step_) * static_cast<size_t>(cellsAcross_) +
           static_cast<size_t>(x / step_);
  }
  float narrowest(int cellX, int cellY, const std::function<float(int x, int y)>& width) const;

  View<const uint8_t> classes_;
  View<const uint32_t> labels_;
  int step_, cellsAcross_;
  std::vector<int> pieces_;  ///< size of the pieces of each cell, pixels
};

}  // namespace kagefude
