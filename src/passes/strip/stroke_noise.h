#pragma once

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

/// Smooth noise of the plane, 0..1: random values on whole (x, y), eased in between. Made for one
/// x, to be asked for many y in rising order: values of the rows around y are kept.
class StrokeNoiseColumn {
 public:
  StrokeNoiseColumn(uint32_t seed, float x) : seed_(seed), x_(floorOf(x)) {
    share_ = eased(x - static_cast<float>(x_));
  }

  float at(float y) {
    const int row = floorOf(y);
    if (!known_ || row != row_) {
      top_ = known_ && row == row_ + 1 ? bottom_ : onRow(row);
      bottom_ = onRow(row + 1);
      row_ = row;
      known_ = true;
    }
    return top_ + (bottom_ - top_) * eased(y - static_cast<float>(row));
  }

 private:
  // Without a call of the C library, which std::floor is on the plainest processors.
  static int floorOf(float value) {
    const int whole = static_cast<int>(value);
    return static_cast<float>(whole) > value ? whole - 1 : whole;
  }
  static float eased(float t) { return t * t * (3.0f - 2.0f * t); }
  float onRow(int row) const {
    const auto on = [&](int column) {
      const uint32_t key = static_cast<uint32_t>(column) ^ scrambled(static_cast<uint32_t>(row));
      return static_cast<float>(scrambled(seed_ ^ scrambled(key)) >> 8) * (1.0f / 16777216.0f);
    };
    const float left = on(x_);
    return left + (on(x_ + 1) - left) * share_;
  }

  uint32_t seed_;
  int x_;
  float share_ = 0, top_ = 0, bottom_ = 0;
  int row_ = 0;
  bool known_ = false;
};

/// The same at one place.
inline float strokeNoise(uint32_t seed, float x, float y) {
  return StrokeNoiseColumn(seed, x).at(y);
}

}  // namespace kagefude
