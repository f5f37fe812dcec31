#pragma once

#include <bit>

#include "passes/strip/strip_lookup.h"

// Lookups of a strip taken apart, inline for the brush pass's inner loops.
namespace kagefude {

/// As probeTolerance: strokes are soft and few probes enough, most surfaces are read with one.
inline constexpr float grainTolerance = 0.75f;

/// Share of the step between two levels over which one fades into the other; beside it one level is
/// read alone.
inline constexpr float levelFade = 0.4f;
inline float levelShare(float between) {
  const float share = (between - 0.5f) * (1.0f / levelFade) + 0.5f;
  const float above = share > 0.0f ? share : 0.0f;
  return above < 1.0f ? above : 1.0f;
}

/// Where a lookup lies in one level of the grain: its texel and the shares of the next ones.
struct GrainPlace {
  int texel = 0;
  float fx = 0, fy = 0;
};

/// u in turns, [0, 1); half the place across the strokes in heights of the grain, [0, 1): it runs
/// back and forth, for rows have no seam to hide.
inline GrainPlace grainPlace(float u, float halfAcross, int width, int height, int offset) {
  const RowPlace row = rowPlace(std::fabs(2.0f * halfAcross - 1.0f), height);
  const ColumnPlace column = columnPlace(u, width);
  return {offset + grainTexel(column.left, row.upper, (width + 3) >> 2), column.fraction,
          row.fraction};
}

/// The grain between four packed texels.
inline float grainBetween(uint32_t four, float fx, float fy) {
  const float a = static_cast<float>(static_cast<int>(four & 255u));
  const float b = static_cast<float>(static_cast<int>(four >> 8 & 255u));
  const float c = static_cast<float>(static_cast<int>(four >> 16 & 255u));
  const float d = static_cast<float>(static_cast<int>(four >> 24));
  const float top = a + (b - a) * fx, bottom = c + (d - c) * fx;
  return (top + (bottom - top) * fy - 128.0f) * StripGrain::perStep;
}

inline float grainAt(const StripGrain& grain, size_t level, float u, float w) {
  const StripGrain::Level& l = grain.levels[level];
  const GrainPlace place =
      grainPlace(fractionOf(u), fractionOf(0.5f * w), l.width, l.height, l.offset);
  return grainBetween(grain.pool.row(0)[place.texel], place.fx, place.fy);
}

/// As log2Of within 2e-4, without a division.
inline float roughLog2(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const float exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
  const float m = std::bit_cast<float>((bits & 0x007fffffu) | 0x3f800000u) - 1.0f;
  // Minimax over [0, 1], exact at both ends so that it is continuous.
  return exponent + m * (1.4384552f + m * (-0.6778900f + m * (0.3230900f + m * -0.0836552f)));
}

/// The ellipse that the unit pixel covers on the grain, in texels; lengths are squared.
struct GrainEllipse {
  float length, shortest;  ///< of the long axis, and of the short one, at least bilinearWidth
  float a, b, c, spread;   ///< for the long axis's direction
};

/// From the footprint vectors (ux, vx), (uy, vy) in texels.
inline GrainEllipse grainEllipse(float ux, float vx, float uy, float vy) {
  constexpr float least = bilinearWidth * bilinearWidth;
  const float a = ux * ux + uy * uy, b = ux * vx + uy * vy, c = vx * vx + vy * vy;
  const float spread = std::sqrt((a - c) * (a - c) + 4.0f * b * b);
  const float longest = 0.5f * (a + c + spread);
  // A small ellipse, and NaN, counts as the least circle, which is one probe of level 0. (A guard
  // against each constant would be threaded into branches, and the loop would not vectorise.)
  const bool large = longest > least;
  const float length = large ? longest : least;
  const float area = ux * vy - uy * vx;
  const float narrow = area * area / length;
  return {length, narrow > least ? narrow : least, a, b, c, spread};
}

/// Whether one probe of level 0 alone does, found without roots and divisions: the ellipse's
/// squared lengths are the eigenvalues of its form, and its polynomial's signs bound them. A little
/// narrower than grainProbes and levelShare have it, so that roundings cannot matter.
inline bool needsOneTexel(float ux, float vx, float uy, float vy) {
  constexpr float longest = 6.1f;   // of 6.125: (1 + grainTolerance) bilinearWidth, squared
  constexpr float shortest = 2.9f;  // of 3.03: 2 to the power of 2 (0.5 + (1 - levelFade) / 2)
  const float trace = ux * ux + uy * uy + (vx * vx + vy * vy);
  const float area = ux * vy - uy * vx;
  const float determinant = area * area;
  const float atLongest = longest * longest - trace * longest + determinant;
  const float atShortest = shortest * shortest - trace * shortest + determinant;
  const bool isShort = (trace <= 2.0f * longest) & (atLongest >= 0.0f);
  const bool isNarrow = (trace <= 2.0f * shortest) | (atShortest <= 0.0f);
  return isShort & isNarrow;
}

/// Level of a probe that covers `share` of the long axis, squared.
inline float grainLod(float share, float shortest) {
  constexpr float reach = 1.0f / ((1.0f + grainTolerance) * (1.0f + grainTolerance));
  const float covered = share * reach > shortest ? share * reach : shortest;
  return 0.5f * roughLog2(covered) - 0.5f;
}

/// As probeEllipse with grainTolerance, but for roughLog2; all but the probes' step is found from
/// squares.
inline void grainProbes(const GrainEllipse& e, float width, float height, float maxProbes,
                        float& probes, float& lod, float& stepU, float& stepV) {
  const float wanted = std::ceil(std::sqrt(e.length / e.shortest) - grainTolerance);
  probes = wanted < maxProbes ? wanted : maxProbes;
  const float inverse = 1.0f / probes;
  const float share = e.length * inverse * inverse;
  lod = grainLod(share, e.shortest);
  const float du = e.a >= e.c ? 0.5f * (e.a - e.c + e.spread) : e.b;
  const float dv = e.a >= e.c ? e.b : 0.5f * (e.c - e.a + e.spread);
  const float step = std::sqrt(share / (du * du + dv * dv));
  stepU = probes > 1.0f ? du * step * (1.0f / width) : 0.0f;
  stepV = probes > 1.0f ? dv * step * (1.0f / height) : 0.0f;
}

inline StripProbe grainProbe(const StripGrain& grain, const Footprint& f, int maxProbes) {
  const float w = static_cast<float>(grain.levels.front().width),
              h = static_cast<float>(grain.levels.front().height);
  StripProbe probe;
  float probes;
  grainProbes(grainEllipse(f.ux * w, f.vx * h, f.uy * w, f.vy * h), w, h,
              static_cast<float>(maxProbes), probes, probe.lod, probe.stepU, probe.stepV);
  probe.count = static_cast<int>(probes);
  return probe;
}

/// Mean of the probes round (u, w), each between two levels.
inline float lookUpGrain(const StripGrain& grain, float u, float w, const StripProbe& probe) {
  const float last = static_cast<float>(grain.levels.size() - 1);
  const float lod = probe.lod < last ? probe.lod : last;
  const auto whole = static_cast<size_t>(lod);
  const float share = levelShare(lod - static_cast<float>(whole));
  const size_t fine = whole + (share >= 1.0f ? 1 : 0);
  const float coarser = share >= 1.0f ? 0.0f : share;
  const float middle = 0.5f * static_cast<float>(probe.count - 1);
  float sum = 0;
  for (int i = 0; i < probe.count; ++i) {
    const float offset = static_cast<float>(i) - middle;
    const float pu = u + offset * probe.stepU, pw = w + offset * probe.stepV;
    sum += grainAt(grain, fine, pu, pw) * (1.0f - coarser);
    if (coarser > 0.0f) sum += grainAt(grain, fine + 1, pu, pw) * coarser;
  }
  return sum / static_cast<float>(probe.count);
}

/// Level of tones by how many of the finest level's rows one pixel's change of tone crosses: the
/// nearest power of two, from the number's exponent.
inline int toneLevel(float change, int rows, int lastLevel) {
  const float crossed = change * static_cast<float>(rows) * 1.41421356f;
  const int level = (std::bit_cast<int>(crossed) >> 23) - 127;
  const int positive = level > 0 ? level : 0;
  return positive < lastLevel ? positive : lastLevel;
}

/// Column of the colours left of a grain, and the share of the next one.
inline float grainColumn(float grain) {
  const float at = (grain + StripGrain::reach) *
                   (static_cast<float>(StripGrain::columns - 1) / (2.0f * StripGrain::reach));
  const float last = static_cast<float>(StripGrain::columns - 1);
  const float above = at > 0.0f ? at : 0.0f;
  return above < last ? above : last;
}

/// Colour of a grain at a tone; `change` is the tone's change over the pixel.
inline Rgba grainColour(const StripGrain& grain, float tone, float value, float change) {
  const int level = toneLevel(change, grain.toneRows, grain.lastToneLevel);
  const RowPlace row = rowPlace(tone, grain.toneRows >> level);
  const int first = toneLevelRow(grain.toneRows, level);
  const float at = grainColumn(value);
  const int whole = static_cast<int>(at);
  const int left = whole < StripGrain::columns - 1 ? whole : StripGrain::columns - 2;
  const Rgba* upper = grain.colours.row(first + row.upper) + left;
  const Rgba* lower = grain.colours.row(first + row.lower) + left;
  return mixFour(upper[0], upper[1], lower[0], lower[1], at - static_cast<float>(left),
                 row.fraction);
}

}  // namespace kagefude
