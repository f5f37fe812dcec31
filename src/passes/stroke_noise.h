#pragma once

#include <cmath>
#include <cstdint>

namespace kagefude {

/// Bits that look random and depend on the key alone.
inline uint32_t scrambled(uint32_t key) {
  key ^= key >> 16;
  key *= 0x7feb352du;
  key ^= key >> 15;
  key *= 0x846ca68bu;
  return key ^ (key >> 16);
}

/// A row of random numbers from two keys.
class StrokeNoise {
 public:
  StrokeNoise(uint32_t seed, uint32_t stream) : state_(scrambled(seed) ^ scrambled(~stream)) {}
  uint32_t nextBits() { return scrambled(state_ += 0x9e3779b9u); }
  /// In [0, 1).
  float next() { return static_cast<float>(nextBits() >> 8) * (1.0f / 16777216.0f); }

 private:
  uint32_t state_;
};

/// Smooth noise of the plane, 0..1: random values on whole (x, y), eased in between.
inline float strokeNoise(uint32_t seed, float x, float y) {
  const float x0 = std::floor(x), y0 = std::floor(y);
  const auto at = [&](int dx, int dy) {
    const uint32_t column = static_cast<uint32_t>(static_cast<int>(x0) + dx);
    const uint32_t row = static_cast<uint32_t>(static_cast<int>(y0) + dy);
    return static_cast<float>(scrambled(seed ^ scrambled(column ^ scrambled(row))) >> 8) *
           (1.0f / 16777216.0f);
  };
  const auto eased = [](float t) { return t * t * (3.0f - 2.0f * t); };
  const float fx = eased(x - x0), fy = eased(y - y0);
  const float top = at(0, 0) + (at(1, 0) - at(0, 0)) * fx;
  const float bottom = at(0, 1) + (at(1, 1) - at(0, 1)) * fx;
  return top + (bottom - top) * fy;
}

}  // namespace kagefude
