#pragma once

#include <cstdint>

#include "passes/strip/stroke_noise.h"

namespace kagefude {

/// Smooth noise of the plane, 0..1, as strokeNoise, that repeats every `across` cells in x and
/// every `down` cells in y (each at least 1).
inline float wrappedNoise(uint32_t seed, float x, float y, int across, int down) {
  const auto floorOf = [](float v) {
    const int whole = static_cast<int>(v);
    return static_cast<float>(whole) > v ? whole - 1 : whole;
  };
  const auto wrapped = [](int cell, int count) {
    const int rest = cell % count;
    return rest < 0 ? rest + count : rest;
  };
  const auto eased = [](float t) { return t * t * (3.0f - 2.0f * t); };
  const int left = floorOf(x), top = floorOf(y);
  const auto value = [&](int column, int row) {
    const uint32_t key = static_cast<uint32_t>(wrapped(column, across)) ^
                         scrambled(static_cast<uint32_t>(wrapped(row, down)));
    return static_cast<float>(scrambled(seed ^ scrambled(key)) >> 8) * (1.0f / 16777216.0f);
  };
  const float fx = eased(x - static_cast<float>(left)), fy = eased(y - static_cast<float>(top));
  const float upper = value(left, top) + (value(left + 1, top) - value(left, top)) * fx;
  const float lower = value(left, top + 1) + (value(left + 1, top + 1) - value(left, top + 1)) * fx;
  return upper + (lower - upper) * fy;
}

/// **[ours]** The height of rough paper at each texel of a strip, 0 in its hollows to 1 on its
/// peaks, round in u: two sizes of noise, `size` texels and half of it.
class PaperTooth {
 public:
  PaperTooth(uint32_t seed, int width, int height, float size)
      : seed_(seed),
        across_(cellsIn(width, size)),
        down_(cellsIn(height, size)),
        perColumn_(static_cast<float>(across_) / static_cast<float>(width)),
        perRow_(static_cast<float>(down_) / static_cast<float>(height)) {}

  float at(float x, float y) const {
    const float u = x * perColumn_, v = y * perRow_;
    return 0.6f * wrappedNoise(seed_, u, v, across_, down_) +
           0.4f * wrappedNoise(~seed_, 2.0f * u, 2.0f * v, 2 * across_, 2 * down_);
  }

 private:
  static int cellsIn(int length, float size) {
    const int cells = static_cast<int>(static_cast<float>(length) / size + 0.5f);
    return cells > 1 ? cells : 1;
  }

  uint32_t seed_;
  int across_, down_;
  float perColumn_, perRow_;
};

}  // namespace kagefude
