#pragma once

#include <vector>

#include "image/plane.h"
#include "passes/strip/strip_grain.h"

namespace kagefude {

/// How far a picture of one pixel reaches on a strip: the change of (u, v) from this pixel to the
/// next one to the right (x) and to the next one below (y).
struct Footprint {
  float ux = 0, vx = 0, uy = 0, vy = 0;
};

/// A painted gradient as the brush pass reads it (002 §3.1): scene-linear colour with associated
/// alpha; v is the tone, 1 on the top edge and 0 on the bottom edge, clamped; u runs round and
/// repeats with period 1. Holds a chain of box-filtered half-size copies, each of which repeats in
/// u like the first, and the mean colour of every row; and the strip taken apart into grain and
/// colours. Movable, about 30 bytes a pixel.
struct Strip {
  struct Level {
    int width = 0, height = 0;
    int offset = 0;           ///< of its first texel in `pool`
    View<const Rgba> texels;  ///< row 0 is the brightest
  };
  bool opaque = true;         ///< alpha is 1 everywhere
  std::vector<Level> levels;  ///< full size first, 1 x 1 last
  Plane<Rgba> pool;           ///< all levels' texels, one after the other
  Plane<Rgba> means;          ///< the full size's row means, brightest first
  StripGrain grain;

  int width() const { return levels.front().width; }
  int height() const { return levels.front().height; }
};

/// Builds a strip from planes of equal size, alpha optional (empty: opaque) and already associated.
/// Throws InputError on an empty picture and on one beyond 16384 pixels a side. Non-finite texels
/// become 0. Cost: two passes over the picture for the chain, and a sort of
/// every row for the grain.
Strip makeStrip(View<const float> r, View<const float> g, View<const float> b,
                View<const float> a = {});

/// The seed's lookup: bilinear between the centres of the full-size texels.
Rgba stripBilinear(const Strip& strip, float u, float v);

/// **[ours]** Mean over the footprint: probes along the long axis of the pixel's ellipse, at most
/// `maxProbes` (beyond that blurred rather than aliased), each trilinear in the chain at the width
/// of the short axis. A footprint below 1.4 texels is stripBilinear, bit for
/// bit, for its tent averages as much. Differences in u
/// must be given without the wrap (0.1 over the seam from 0.95 to 0.05, not -0.9).
/// Against an average of many bilinear lookups: within about 0.02 of the strip's range (tested).
Rgba stripFiltered(const Strip& strip, float u, float v, const Footprint& footprint, int maxProbes);

/// Mean colour of the strip's row at v, between the rows' centres linear.
Rgba stripRowMean(const Strip& strip, float v);

}  // namespace kagefude
