#pragma once

#include <algorithm>

#include "image/parallel.h"
#include "passes/edges/edge_tones.h"

namespace kagefude {

/// A picture whose pixels are mixed(x, y) but where plain(x, y), as most are: those are taken over
/// bit for bit.
template <class Plain, class Mixed>
ColourPlanes mixAtEdges(const ColourViews& colour, const Plain& plain, const Mixed& mixed) {
  const int width = colour.r.width, height = colour.r.height;
  ColourPlanes result{Floats(width, height), Floats(width, height), Floats(width, height),
                      Floats(width, height)};
  const PaintViews views{result.r.view(), result.g.view(), result.b.view(), result.a.view()};
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      std::copy_n(colour.r.row(y), width, result.r.row(y));
      std::copy_n(colour.g.row(y), width, result.g.row(y));
      std::copy_n(colour.b.row(y), width, result.b.row(y));
      std::copy_n(colour.a.row(y), width, result.a.row(y));
      for (int x = 0; x < width; ++x) {
        if (plain(x, y)) continue;
        setPaint(views, x, y, mixed(x, y));
      }
    }
  });
  return result;
}

}  // namespace kagefude
