#pragma once

#include <vector>

#include "image/parallel.h"
#include "passes/edges/edge_tones.h"

namespace kagefude {

/// Makes a picture's pixels mixed(x, y) but where plain(x, y), as most are: those keep their bits.
/// Colours are set when all have been read, so that `mixed` may read around it.
template <class Plain, class Mixed>
void mixAtEdges(const PaintViews& paint, const Plain& plain, const Mixed& mixed) {
  struct Pixel {
    int x;
    Rgba colour;
  };
  std::vector<std::vector<Pixel>> rows(static_cast<size_t>(paint.r.height));
  parallelRows(paint.r.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < paint.r.width; ++x)
        if (!plain(x, y)) rows[static_cast<size_t>(y)].push_back({x, mixed(x, y)});
  });
  parallelRows(paint.r.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (const Pixel& pixel : rows[static_cast<size_t>(y)])
        setPaint(paint, pixel.x, y, pixel.colour);
  });
}

}  // namespace kagefude
