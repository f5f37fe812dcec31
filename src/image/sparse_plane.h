#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kagefude {

/// A rectangle of 32-bit words of which most are 0, such as all ranks of a Cryptomatte but the
/// first: of each row only blocks that hold something are kept. A plane of a picture with few edges
/// takes a twentieth of a full one; one without any zeros takes a 32nd more than that.
class SparsePlane {
 public:
  static constexpr int block = 32;

  SparsePlane() = default;
  /// All 0.
  SparsePlane(int width, int height) : width_(width), rows_(static_cast<size_t>(height)) {}

  int width() const { return width_; }
  int height() const { return static_cast<int>(rows_.size()); }
  bool empty() const { return rows_.empty(); }

  uint32_t operator()(int x, int y) const {
    const std::vector<uint32_t>& row = rows_[static_cast<size_t>(y)];
    if (row.empty()) return 0;
    const uint32_t start = row[static_cast<size_t>(x / block)];
    return start ? row[start + static_cast<size_t>(x % block)] : 0;
  }
  float asFloat(int x, int y) const { return std::bit_cast<float>((*this)(x, y)); }

  /// Takes `width` words or floats at any address as row y. Rows may be set side by side.
  void setRow(int y, const void* words);
  /// The words of row y that are kept, without their places, to be changed.
  std::span<uint32_t> keptOf(int y);
  std::span<const uint32_t> keptOf(int y) const;
  void clear(int x, int y);
  /// What the pixels take.
  size_t bytes() const;

 private:
  size_t blocks() const { return (static_cast<size_t>(width_) + block - 1) / block; }

  int width_ = 0;
  /// Where in the row each block starts, 0 for those of zeros, and then the blocks; or empty.
  std::vector<std::vector<uint32_t>> rows_;
};

}  // namespace kagefude
