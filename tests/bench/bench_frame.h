#pragma once

#include <cmath>

#include "image/parallel.h"
#include "image/plane.h"
#include "passes/search/classes.h"

// A synthetic frame of any size: a ground and 20 discs, and across all of them shadows with soft
// rims, about a quarter of the pixels in penumbra.
namespace kagefude::bench {

/// One of 21 objects, 0 to 20, at a pixel of a frame of the given size.
inline int objectAt(int x, int y, int width, int height) {
  for (int i = 0; i < 20; ++i) {
    const int cx = width * 5 / 96 + (i * width / 5) % (width * 43 / 48);
    const int cy = height * 5 / 72 + (i * height * 7 / 36) % (height * 31 / 36);
    const int r = (90 + 13 * i) * width / 3840;
    if ((x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r) return i + 1;
  }
  return 0;
}

/// umbra, penumbra or lit by the distance to a grid of shadow centres.
inline ShadowClass classAt(int x, int y, int width, int height) {
  const float pitch = static_cast<float>(width) / 6;
  const float u = std::remainder(static_cast<float>(x) - 0.11f * static_cast<float>(width), pitch);
  const float v = std::remainder(static_cast<float>(y) - 0.2f * static_cast<float>(height), pitch);
  const float d = std::sqrt(u * u + v * v) / pitch;
  return d < 0.2f ? ShadowClass::umbra : (d < 0.34f ? ShadowClass::penumbra : ShadowClass::lit);
}

struct LabelledShadow {
  Labels labels;
  Bytes classes;

  LabelledShadow(int width, int height) : labels(width, height), classes(width, height) {
    parallelRows(height, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < width; ++x) {
          labels(x, y) = static_cast<uint32_t>(1 + objectAt(x, y, width, height));
          classes(x, y) = static_cast<uint8_t>(classAt(x, y, width, height));
        }
    });
  }
};

}  // namespace kagefude::bench
