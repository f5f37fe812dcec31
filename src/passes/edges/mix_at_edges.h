#pragma once

#include <algorithm>

#include "image/parallel.h"
#include "passes/edges/coverage_blend.h"
#include "passes/strip/strip.h"

namespace kagefude {

inline Rgba colourAt(const ColourViews& c, int x, int y) {
  return Rgba{c.r(x, y), c.g(x, y), c.b(x, y), c.a(x, y)};
}

/// A picture whose pixels are mixed(x, y) but where plain(x, y), as most are: those are taken over
/// bit for bit.
template <class Plain, class Mixed>
ColourPlanes mixAtEdges(const ColourViews& colour, const Plain& plain, const Mixed& mixed) {
  const int width = colour.r.width, height = colour.r.height;
  ColourPlanes result{Floats(width, height), Floats(width, height), Floats(width, height),
                      Floats(width, height)};
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      std::copy_n(colour.r.row(y), width, result.r.row(y));
      std::copy_n(colour.g.row(y), width, result.g.row(y));
      std::copy_n(colour.b.row(y), width, result.b.row(y));
      std::copy_n(colour.a.row(y), width, result.a.row(y));
      for (int x = 0; x < width; ++x) {
        if (plain(x, y)) continue;
        const Rgba c = mixed(x, y);
        result.r(x, y) = c[0];
        result.g(x, y) = c[1];
        result.b(x, y) = c[2];
        result.a(x, y) = c[3];
      }
    }
  });
  return result;
}

}  // namespace kagefude
