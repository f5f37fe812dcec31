#include "exr/fast_kernels.h"

#include <bit>
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

uint32_t floatBits(uint16_t half) {
  const uint32_t sign = static_cast<uint32_t>(half & 0x8000u) << 16;
  const uint32_t exponent = (half >> 10) & 31u;
  const uint32_t mantissa = half & 1023u;
  if (exponent == 31) return sign | 0x7f800000u | mantissa << 13;
  if (exponent != 0) return sign | (exponent + 112) << 23 | mantissa << 13;
  if (mantissa == 0) return sign;
  // A denormal half is a normal float: move its leading one into the hidden place.
  const int shift = std::countl_zero(mantissa) - 21;
  return sign | static_cast<uint32_t>(113 - shift) << 23 | ((mantissa << shift) & 1023u) << 13;
}

/// value / 2^shift to the nearest integer, ties to even.
uint32_t roundedShift(uint32_t value, int shift) {
  const uint32_t whole = value >> shift;
  const uint32_t rest = value & ((1u << shift) - 1);
  const uint32_t tie = 1u << (shift - 1);
  return whole + (rest > tie || (rest == tie && (whole & 1)) ? 1 : 0);
}

uint16_t halfBits(uint32_t bits) {
  const uint32_t sign = bits >> 16 & 0x8000u;
  const uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) {
    const uint32_t payload = magnitude >> 13 & 1023u;
    return static_cast<uint16_t>(sign | 0x7c00u | (payload ? payload : 1u));
  }
  if (magnitude >= 0x477ff000u) return static_cast<uint16_t>(sign | 0x7c00u);  // rounds past 65504
  const int exponent = static_cast<int>(magnitude >> 23);
  if (exponent >= 113) {
    // A carry out of the mantissa steps the exponent, which is just what rounding up means.
    return static_cast<uint16_t>(sign | roundedShift(magnitude - (112u << 23), 13));
  }
  if (exponent < 102) return static_cast<uint16_t>(sign);  // below half of the least denormal
  const uint32_t mantissa = (magnitude & 0x7fffffu) | 0x800000u;
  return static_cast<uint16_t>(sign | roundedShift(mantissa, 126 - exponent));
}

void halfToFloat(const uint16_t* in, size_t n, float* out) {
  for (size_t i = 0; i < n; ++i) {
    const uint32_t bits = floatBits(in[i]);
    std::memcpy(out + i, &bits, sizeof bits);  // a float register might quiet a signalling NaN
  }
}

void floatToHalf(const float* in, size_t n, uint16_t* out) {
  for (size_t i = 0; i < n; ++i) {
    uint32_t bits;
    std::memcpy(&bits, in + i, sizeof bits);
    out[i] = halfBits(bits);
  }
}

}  // namespace

const ExrKernels& plainExrKernels() {
  static const ExrKernels kernels = {"plain", sumBytes,    unpack,     split,
                                     predict, halfToFloat, floatToHalf};
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
