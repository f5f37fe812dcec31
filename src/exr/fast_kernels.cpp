#include "exr/fast_kernels.h"

#include <Imath/half.h>

#include <cmath>
#include <cstring>

#include "exr/fast_kernels_avx2.h"

namespace kagefude {
namespace {

uint8_t sumBytes(const uint8_t* bytes, size_t n) {
  uint32_t sum = 0;
  for (size_t i = 0; i < n; ++i) sum += bytes[i];
  return static_cast<uint8_t>(sum);
}

void unpack(const uint8_t* low, const uint8_t* high, size_t n, ExrCarry& carry, uint8_t* out) {
  for (size_t i = 0; i < n; ++i) {
    carry.low = static_cast<uint8_t>(carry.low + low[i] + 128);
    carry.high = static_cast<uint8_t>(carry.high + high[i] + 128);
    out[2 * i] = carry.low;
    out[2 * i + 1] = carry.high;
  }
}

void split(const uint8_t* pairs, size_t n, uint8_t* low, uint8_t* high) {
  for (size_t i = 0; i < n; ++i) {
    low[i] = pairs[2 * i];
    high[i] = pairs[2 * i + 1];
  }
}

void predict(const uint8_t* in, size_t n, uint8_t* out) {
  if (n == 0) return;
  out[0] = in[0];
  for (size_t i = 1; i < n; ++i) out[i] = static_cast<uint8_t>(in[i] - in[i - 1] + 128);
}

void halfToFloat(const uint16_t* in, size_t n, float* out) {
  for (size_t i = 0; i < n; ++i) out[i] = imath_half_to_float(in[i]);
}

void floatToHalf(const float* in, size_t n, uint16_t* out) {
  for (size_t i = 0; i < n; ++i) out[i] = imath_float_to_half(in[i]);
}

size_t floatToMask(const uint8_t* floats, size_t n, uint8_t* out) {
  size_t unknown = 0;
  for (size_t i = 0; i < n; ++i) {
    float value;
    std::memcpy(&value, floats + i * sizeof value, sizeof value);
    const bool known = std::isfinite(value);
    out[i] = !known || value >= 0.5f ? 1 : 0;
    unknown += !known;
  }
  return unknown;
}

}  // namespace

const ExrKernels& plainExrKernels() {
  static const ExrKernels kernels = {"plain", sumBytes,    unpack,      split,
                                     predict, halfToFloat, floatToHalf, floatToMask};
  return kernels;
}

std::vector<const ExrKernels*> exrKernelLevels() {
  std::vector<const ExrKernels*> levels = {&plainExrKernels()};
  if (const ExrKernels* avx2 = avx2ExrKernels()) levels.push_back(avx2);
  return levels;
}

const ExrKernels& fastestExrKernels() {
  static const ExrKernels* const fastest = exrKernelLevels().back();
  return *fastest;
}

}  // namespace kagefude
