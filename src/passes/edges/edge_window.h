#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "image/real_math.h"

namespace kagefude {

/// The Gaussian window through which a pixel at a border looks for where the border runs.
class EdgeWindow {
 public:
  static constexpr int radius = 3;
  static constexpr float sigma = 1.3f;  ///< pixels

  EdgeWindow() {
    float* weight = weights_.data();
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx)
        *weight++ = exp2Of(-0.72134752f * static_cast<float>(dx * dx + dy * dy) / (sigma * sigma));
    float middle = 0, gradient = 0;
    weight = weights_.data();
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx, ++weight) {
        if (dx == 0) middle += *weight;
        if (dx <= 0) gradient -= *weight * static_cast<float>(dx);
      }
    slopeOfGradient_ = middle / gradient;
  }

  /// What the window sees of the pixel's own side.
  struct Side {
    float sum = 0, own = 0;            ///< weights of all pixels, and of its own side
    float towardsX = 0, towardsY = 0;  ///< its own side's weights by their distance, unscaled
  };

  /// isOwn(qx, qy, dx, dy): whether the pixel q = p + d is on p's side. Beyond the frame, of
  /// `width` x `height` pixels, things go on as they are at its border.
  template <class IsOwn>
  Side sideOf(int x, int y, int width, int height, const IsOwn& isOwn) const {
    Side side;
    const float* weight = weights_.data();
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx, ++weight) {
        const int qx = std::clamp(x + dx, 0, width - 1), qy = std::clamp(y + dy, 0, height - 1);
        side.sum += *weight;
        if (!isOwn(qx, qy, dx, dy)) continue;
        side.own += *weight;
        side.towardsX += *weight * static_cast<float>(dx);
        side.towardsY += *weight * static_cast<float>(dy);
      }
    return side;
  }

  /// What the share of a side in the window changes by a pixel, over its gradient: from a straight
  /// border along the pixels, which lies half a pixel from their centres.
  float slopeOfGradient() const { return slopeOfGradient_; }

 private:
  static constexpr size_t across = 2 * radius + 1;
  std::array<float, across * across> weights_;
  float slopeOfGradient_;
};

}  // namespace kagefude
