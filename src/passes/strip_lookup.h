#pragma once

#include <algorithm>
#include <cmath>

#include "image/real_math.h"
#include "passes/strip.h"

// The strip's lookups, inline for the brush pass's inner loop.
namespace kagefude {

/// How to read a footprint: `count` probes at (u, v) + step * (i - (count - 1) / 2), at level
/// `lod`.
struct StripProbe {
  float stepU = 0, stepV = 0;
  float lod = 0;
  int count = 1;
};

/// Bilinear lookup in one level; u in [0, 1), v clamped to the outermost rows' centres. A NaN reads
/// the bottom row, left edge.
inline Rgba bilinearTexels(const Strip::Level& level, float u, float v) {
  const float x = u * static_cast<float>(level.width) - 0.5f;
  const float highest = static_cast<float>(level.height - 1);
  const float down = (1.0f - v) * static_cast<float>(level.height) - 0.5f;
  const float y = down > 0.0f ? (down < highest ? down : highest) : (down <= 0.0f ? 0.0f : highest);
  // Truncation of x + 1 is the floor, for x is above -1.
  int x0 = static_cast<int>(x + 1.0f) - 1;
  const int y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  int x1 = x0 + 1;
  x0 = x0 < 0 ? level.width - 1 : x0;
  x1 = x1 >= level.width ? 0 : x1;
  const Rgba* upper = level.texels.row(y0);
  const Rgba* lower = level.texels.row(y0 + 1 < level.height ? y0 + 1 : y0);
  const Rgba top = upper[x0] + (upper[x1] - upper[x0]) * fx;
  const Rgba bottom = lower[x0] + (lower[x1] - lower[x0]) * fx;
  return top + (bottom - top) * fy;
}

/// Trilinear lookup; lod <= 0 is the full-size level alone.
inline Rgba trilinearTexels(const Strip& strip, float u, float v, float lod) {
  const float wrapped = u - std::floor(u);
  // Rounding can lift a tiny negative u to 1 exactly.
  const float inside = wrapped < 1.0f ? wrapped : 0.0f;
  if (!(lod > 0.0f)) return bilinearTexels(strip.levels.front(), inside, v);
  const int last = static_cast<int>(strip.levels.size()) - 1;
  const float level = lod < static_cast<float>(last) ? lod : static_cast<float>(last);
  const int fine = static_cast<int>(level);
  const Rgba a = bilinearTexels(strip.levels[fine], inside, v);
  if (fine == last) return a;
  const Rgba b = bilinearTexels(strip.levels[fine + 1], inside, v);
  return a + (b - a) * (level - static_cast<float>(fine));
}

/// Row mean at v in one level or between two, as trilinearTexels.
inline Rgba rowMeanAt(const Strip& strip, float v, float lod) {
  const int last = static_cast<int>(strip.levels.size()) - 1;
  const auto at = [v](const Strip::Level& level) {
    const float highest = static_cast<float>(level.height - 1);
    const float down = (1.0f - v) * static_cast<float>(level.height) - 0.5f;
    const float y = down > 0.0f ? (down < highest ? down : highest) : 0.0f;
    const int y0 = static_cast<int>(y);
    const Rgba a = level.rowMeans(0, y0);
    return a + (level.rowMeans(0, std::min(y0 + 1, level.height - 1)) - a) *
                   (y - static_cast<float>(y0));
  };
  if (!(lod > 0.0f)) return at(strip.levels.front());
  const float level = lod < static_cast<float>(last) ? lod : static_cast<float>(last);
  const int fine = static_cast<int>(level);
  const Rgba a = at(strip.levels[fine]);
  return fine == last ? a : a + (at(strip.levels[fine + 1]) - a) * (level - float(fine));
}

/// Width in texels up to which bilinear interpolation alone averages enough: its tent has the
/// spread of a box of this width.
inline constexpr float bilinearWidth = 1.41421356f;

/// The ellipse that the unit pixel covers on the strip, from the matrix whose columns are the two
/// footprint vectors in texels (ux, vx), (uy, vy): its long axis is split into probes, its short
/// axis picks the level. `width`, `height`: of the full-size strip. Without branches, so that loops
/// over pixels vectorise; `probes` is a whole number.
inline void probeEllipse(float ux, float vx, float uy, float vy, float width, float height,
                         float maxProbes, float& probes, float& lod, float& stepU, float& stepV) {
  const float a = ux * ux + uy * uy, b = ux * vx + uy * vy, c = vx * vx + vy * vy;
  const float spread = std::sqrt((a - c) * (a - c) + 4.0f * b * b);
  const float longest = std::sqrt(0.5f * (a + c + spread));
  // NaN takes the small side of every comparison and ends as one lookup.
  const bool large = longest > bilinearWidth;
  const float area = std::fabs(ux * vy - uy * vx);
  const float narrow = large ? area / longest : 0.0f;
  const float shortest = narrow > bilinearWidth ? narrow : bilinearWidth;
  const float wanted = large ? std::ceil(longest / shortest) : 1.0f;
  probes = wanted < maxProbes ? wanted : maxProbes;
  const float share = longest / probes;
  const float level = log2Of(large ? (shortest > share ? shortest : share) : 1.0f) - 0.5f;
  lod = level > 1e-6f ? level : 0.0f;
  // Of the two expressions for the long axis's direction, the one without cancellation.
  const float du = a >= c ? 0.5f * (a - c + spread) : b;
  const float dv = a >= c ? b : 0.5f * (c - a + spread);
  const float norm = std::sqrt(du * du + dv * dv);
  const float step = probes > 1.0f ? share / norm : 0.0f;
  stepU = step > 0.0f ? du * step / width : 0.0f;
  stepV = step > 0.0f ? dv * step / height : 0.0f;
}

inline StripProbe stripProbe(const Strip& strip, const Footprint& f, int maxProbes) {
  const float w = static_cast<float>(strip.width()), h = static_cast<float>(strip.height());
  StripProbe probe;
  float probes;
  probeEllipse(f.ux * w, f.vx * h, f.uy * w, f.vy * h, w, h, static_cast<float>(maxProbes), probes,
               probe.lod, probe.stepU, probe.stepV);
  probe.count = static_cast<int>(probes);
  return probe;
}

/// Mean of the probes round (u, v).
inline Rgba lookUp(const Strip& strip, float u, float v, const StripProbe& probe) {
  if (probe.count <= 1) return trilinearTexels(strip, u, v, probe.lod);
  Rgba sum{};
  const float middle = 0.5f * static_cast<float>(probe.count - 1);
  for (int i = 0; i < probe.count; ++i) {
    const float offset = static_cast<float>(i) - middle;
    sum += trilinearTexels(strip, u + offset * probe.stepU, v + offset * probe.stepV, probe.lod);
  }
  return sum * (1.0f / static_cast<float>(probe.count));
}

}  // namespace kagefude
