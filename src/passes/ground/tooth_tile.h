#pragma once

#include <algorithm>
#include <cmath>

#include "image/plane.h"
#include "passes/ground/paper.h"

namespace kagefude {

/// Height of the paper's surface and how it faces a low light from the upper left.
struct ToothSample {
  float height = 0.5f;  ///< 0 in the deepest hollow, 1 on the highest ridge; evenly spread
  float slope = 0;      ///< positive towards the light; about -2..2
};

/// **[ours]** A square of paper that repeats without a seam, one texel for each pixel at the size
/// asked for. Heights are ranked, so that any share h of the paper lies below the height h: a
/// pressure is a share of the paper. Made of gradient noise of two octaves (rough), of threads that
/// run over and under each other (canvas), or of lines with chain lines across (laid). Depends on
/// the parameters alone. About 0.25 megatexels, some 10 ms.
class ToothTile {
 public:
  explicit ToothTile(const PaperParams& params);

  int size() const { return height_.width(); }
  /// Texels to one grain.
  float texelsPerGrain() const { return texelsPerGrain_; }
  /// The texel at whole (x, y), however far out.
  ToothSample at(int x, int y) const {
    const int column = wrapped(x), row = wrapped(y);
    return {height_(column, row), slope_(column, row)};
  }
  /// The `count` texels from (x, y) to the right, as at() gives them.
  void copyRow(int x, int y, int count, float* height, float* slope) const;
  /// Between the texels' centres bilinear; u, v in grains, within 2^20 of 0.
  ToothSample between(float u, float v) const;

 private:
  int wrapped(int i) const {
    const int rest = i % size();
    return rest < 0 ? rest + size() : rest;
  }

  float texelsPerGrain_ = 1;
  Floats height_, slope_;
};

}  // namespace kagefude
