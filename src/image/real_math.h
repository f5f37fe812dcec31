#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

// Transcendental functions whose bits are the same on every machine: libm picks other code, with
// other last bits, for processors that have fused multiply-add. Plain arithmetic, no tables, no
// branches that a compiler cannot turn into selects, so loops over pixels vectorise.
namespace kagefude {

inline constexpr float pi = 3.14159265358979323846f;

/// Angle of (x, y) in turns, in [0, 1): 0 on the +x axis, 0.25 on +y. (0,0) gives 0.
/// Odd polynomial of degree 11 on the octant (minimax); absolute error below 1e-6 turns.
inline float turnsOf(float y, float x) {
  const float ax = std::fabs(x), ay = std::fabs(y);
  const float large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  const float t = large > 0.0f ? small / large : 0.0f;
  const float s = t * t;
  float a = -0.0117212f;
  a = a * s + 0.05265332f;
  a = a * s - 0.11643287f;
  a = a * s + 0.19354346f;
  a = a * s - 0.33262347f;
  a = a * s + 0.99997726f;
  a = a * t * 0.15915494309189535f;
  a = ay > ax ? 0.25f - a : a;
  a = x < 0.0f ? 0.5f - a : a;
  a = y < 0.0f ? 1.0f - a : a;
  return a >= 1.0f ? a - 1.0f : a;
}

/// sin and cos of `turns` full turns; |turns| below 2^20. Absolute error below 1e-6.
struct SinCos {
  float sin, cos;
};
inline SinCos sinCosTurns(float turns) {
  const float quarters = turns * 4.0f;
  const float nearest = std::floor(quarters + 0.5f);
  const float r = (quarters - nearest) * 1.57079632679489662f;
  const float s = r * r;
  const float sine =
      r * (1.0f + s * (-0.16666667f + s * (8.3333310e-3f + s * (-1.984090e-4f + s * 2.7526e-6f))));
  const float cosine =
      1.0f + s * (-0.5f + s * (4.1666668e-2f +
                               s * (-1.3888890e-3f + s * (2.4801588e-5f - s * 2.7557e-7f))));
  const int quarter = static_cast<int>(nearest);
  const bool swapped = (quarter & 1) != 0;
  const float up = swapped ? cosine : sine, along = swapped ? sine : cosine;
  return {(quarter & 2) != 0 ? -up : up, ((quarter + 1) & 2) != 0 ? -along : along};
}

/// Base-2 logarithm of a positive normal number; relative to 1, absolute error below 2e-7 near 1
/// and 1e-6 elsewhere. Zero and negatives give -126.
inline float log2Of(float value) {
  if (!(value > 1.1754944e-38f)) return -126.0f;
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  int exponent = static_cast<int>(bits >> 23) - 127;
  float m = std::bit_cast<float>((bits & 0x007fffffu) | 0x3f800000u);
  if (m > 1.41421356f) {
    m *= 0.5f;
    ++exponent;
  }
  const float z = (m - 1.0f) / (m + 1.0f), s = z * z;
  const float series = 1.0f + s * (0.33333333f + s * (0.2f + s * (0.14285714f + s * 0.11111111f)));
  return static_cast<float>(exponent) + 2.88539008f * z * series;
}

/// 2 to the power x, x clamped to [-126, 127]; relative error below 1e-6.
inline float exp2Of(float x) {
  const float clamped = x < -126.0f ? -126.0f : (x > 127.0f ? 127.0f : x);
  const float whole = std::floor(clamped + 0.5f);
  const float f = (clamped - whole) * 0.69314718f;
  const float series =
      1.0f +
      f * (1.0f + f * (0.5f + f * (0.16666667f +
                                   f * (0.041666667f + f * (8.3333333e-3f + f * 1.3888889e-3f)))));
  return series *
         std::bit_cast<float>((static_cast<uint32_t>(static_cast<int>(whole) + 127)) << 23);
}

/// value to the power exponent for value >= 0; 0 gives 0 (exponent > 0).
inline float powerOf(float value, float exponent) {
  return value <= 0.0f ? 0.0f : exp2Of(exponent * log2Of(value));
}

}  // namespace kagefude
