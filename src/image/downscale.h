#pragma once

#include <cstdint>

#include "image/box_reduce.h"
#include "image/parallel.h"
#include "image/plane.h"
#include "image/window.h"

namespace kagefude {

/// A window's pixels in squares of `scale` x `scale`, each to become one pixel. Squares begin at
/// multiples of `scale` in the picture's own coordinates, so that windows that are cropped to
/// something else still fall on the same smaller pixels; at the window's rim they may hold fewer.
/// Sums run in raster order in doubles: the same bits for any number of threads.
class Downscale {
 public:
  /// `scale` is at least 1.
  Downscale(const Window& large, int scale);

  /// What the squares cover, in smaller pixels.
  const Window& window() const { return small_; }
  /// A square's pixels, from the large window's first column or row on. None is empty.
  BoxSpan across(int x) const { return span(small_.x + x, large_.x, large_.width); }
  BoxSpan down(int y) const { return span(small_.y + y, large_.y, large_.height); }

  /// Mean of the square's pixels that are there: for numbers.
  Floats mean(View<const float> plane) const;
  /// Sum over scale², as if there were nothing around the window: for colours with their alpha.
  Floats share(View<const float> plane) const;
  /// Of each square the place (in raster order of the large window) of the pixel that stands for it
  /// where values must not be mixed: of those with the label that most of the square has (the least
  /// of equal ones) the nearest to the middle, the first of equal ones.
  Labels standing(View<const uint32_t> labels) const;
  /// The pixels at those places.
  template <class T>
  Plane<T> pick(View<const T> plane, View<const uint32_t> places) const {
    Plane<T> result(small_.width, small_.height);
    parallelRows(small_.height, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < small_.width; ++x) result(x, y) = plane.data[places(x, y)];
    });
    return result;
  }

 private:
  BoxSpan span(int place, int first, int size) const;

  Window large_, small_;
  int scale_;
};

}  // namespace kagefude
