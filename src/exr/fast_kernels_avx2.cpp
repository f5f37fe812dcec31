#include "exr/fast_kernels_avx2.h"

#if defined(__x86_64__)

#include <cpuid.h>
#include <immintrin.h>

#define KAGEFUDE_AVX2 __attribute__((target("avx2,f16c")))

namespace kagefude {
namespace {

KAGEFUDE_AVX2 __m256i load(const void* p) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}

KAGEFUDE_AVX2 void store(void* p, __m256i v) { _mm256_storeu_si256(static_cast<__m256i*>(p), v); }

KAGEFUDE_AVX2 uint8_t sumBytes(const uint8_t* bytes, size_t n) {
  __m256i sums = _mm256_setzero_si256();
  size_t i = 0;
  for (; i + 32 <= n; i += 32) {
    sums = _mm256_add_epi64(sums, _mm256_sad_epu8(load(bytes + i), _mm256_setzero_si256()));
  }
  const __m128i pair =
      _mm_add_epi64(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
  const uint8_t whole = static_cast<uint8_t>(_mm_cvtsi128_si64(pair) + _mm_extract_epi64(pair, 1));
  return static_cast<uint8_t>(whole + plainExrKernels().sumBytes(bytes + i, n - i));
}

/// Running sums over 32 bytes modulo 256, each with 128 added once a byte.
KAGEFUDE_AVX2 __m256i runningSums(__m256i v) {
  v = _mm256_add_epi8(v, _mm256_slli_si256(v, 1));
  v = _mm256_add_epi8(v, _mm256_slli_si256(v, 2));
  v = _mm256_add_epi8(v, _mm256_slli_si256(v, 4));
  v = _mm256_add_epi8(v, _mm256_slli_si256(v, 8));
  const __m256i lowerLane = _mm256_permute2x128_si256(v, v, 0x08);
  v = _mm256_add_epi8(v, _mm256_shuffle_epi8(lowerLane, _mm256_set1_epi8(15)));
  return _mm256_xor_si256(v, _mm256_set1_epi16(0x0080));  // after an odd number of 128s
}

KAGEFUDE_AVX2 __m256i lastByte(__m256i v) {
  return _mm256_shuffle_epi8(_mm256_permute4x64_epi64(v, 0xff), _mm256_set1_epi8(7));
}

KAGEFUDE_AVX2 void unpack(const uint8_t* low, const uint8_t* high, size_t n, ExrCarry& carry,
                          uint8_t* out) {
  __m256i carryLow = _mm256_set1_epi8(static_cast<char>(carry.low));
  __m256i carryHigh = _mm256_set1_epi8(static_cast<char>(carry.high));
  size_t i = 0;
  for (; i + 32 <= n; i += 32) {
    const __m256i sumsLow = runningSums(load(low + i));
    const __m256i sumsHigh = runningSums(load(high + i));
    const __m256i a = _mm256_add_epi8(sumsLow, carryLow);
    const __m256i b = _mm256_add_epi8(sumsHigh, carryHigh);
    // The carries take only the sums' last bytes: one addition from block to block.
    carryLow = _mm256_add_epi8(carryLow, lastByte(sumsLow));
    carryHigh = _mm256_add_epi8(carryHigh, lastByte(sumsHigh));
    const __m256i first = _mm256_unpacklo_epi8(a, b);
    const __m256i second = _mm256_unpackhi_epi8(a, b);
    store(out + 2 * i, _mm256_permute2x128_si256(first, second, 0x20));
    store(out + 2 * i + 32, _mm256_permute2x128_si256(first, second, 0x31));
  }
  carry.low = static_cast<uint8_t>(_mm256_extract_epi8(carryLow, 0));
  carry.high = static_cast<uint8_t>(_mm256_extract_epi8(carryHigh, 0));
  plainExrKernels().unpack(low + i, high + i, n - i, carry, out + 2 * i);
}

KAGEFUDE_AVX2 void split(const uint8_t* pairs, size_t n, uint8_t* low, uint8_t* high) {
  const __m256i even = _mm256_set1_epi16(0x00ff);
  size_t i = 0;
  for (; i + 32 <= n; i += 32) {
    const __m256i first = load(pairs + 2 * i);
    const __m256i second = load(pairs + 2 * i + 32);
    const __m256i a =
        _mm256_packus_epi16(_mm256_and_si256(first, even), _mm256_and_si256(second, even));
    const __m256i b =
        _mm256_packus_epi16(_mm256_srli_epi16(first, 8), _mm256_srli_epi16(second, 8));
    store(low + i, _mm256_permute4x64_epi64(a, 0xd8));
    store(high + i, _mm256_permute4x64_epi64(b, 0xd8));
  }
  plainExrKernels().split(pairs + 2 * i, n - i, low + i, high + i);
}

KAGEFUDE_AVX2 void predict(const uint8_t* in, size_t n, uint8_t* out) {
  if (n == 0) return;
  out[0] = in[0];
  const __m256i middle = _mm256_set1_epi8(static_cast<char>(128));
  size_t i = 1;
  for (; i + 32 <= n; i += 32) {
    store(out + i, _mm256_xor_si256(_mm256_sub_epi8(load(in + i), load(in + i - 1)), middle));
  }
  for (; i < n; ++i) out[i] = static_cast<uint8_t>(in[i] - in[i - 1] + 128);
}

KAGEFUDE_AVX2 void halfToFloat(const uint16_t* in, size_t n, float* out) {
  size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    const __m128i halves = _mm_loadu_si128(reinterpret_cast<const __m128i*>(in + i));
    const __m256i converted = _mm256_castps_si256(_mm256_cvtph_ps(halves));
    // The instruction quiets signalling NaNs, so infinities and NaNs are put together from bits.
    const __m256i bits = _mm256_cvtepu16_epi32(halves);
    const __m256i exponent = _mm256_set1_epi32(0x7c00);
    const __m256i special = _mm256_cmpeq_epi32(_mm256_and_si256(bits, exponent), exponent);
    const __m256i sign = _mm256_slli_epi32(_mm256_and_si256(bits, _mm256_set1_epi32(0x8000)), 16);
    const __m256i payload =
        _mm256_slli_epi32(_mm256_and_si256(bits, _mm256_set1_epi32(0x03ff)), 13);
    const __m256i put =
        _mm256_or_si256(_mm256_or_si256(sign, payload), _mm256_set1_epi32(0x7f800000));
    store(out + i, _mm256_blendv_epi8(converted, put, special));
  }
  plainExrKernels().halfToFloat(in + i, n - i, out + i);
}

KAGEFUDE_AVX2 void floatToHalf(const float* in, size_t n, uint16_t* out) {
  size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    const __m256 floats = _mm256_loadu_ps(in + i);
    if (_mm256_movemask_ps(_mm256_cmp_ps(floats, floats, _CMP_UNORD_Q)) != 0) {
      plainExrKernels().floatToHalf(in + i, 8, out + i);  // the instruction quiets NaNs
      continue;
    }
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + i),
                     _mm256_cvtps_ph(floats, _MM_FROUND_TO_NEAREST_INT));
  }
  plainExrKernels().floatToHalf(in + i, n - i, out + i);
}

KAGEFUDE_AVX2 __m256 eightFloats(const uint8_t* floats) {
  return _mm256_castsi256_ps(load(floats));
}

/// All bits set in each of 8 values of at least 0.5.
KAGEFUDE_AVX2 __m256i atLeastHalf(const uint8_t* floats) {
  return _mm256_castps_si256(_mm256_cmp_ps(eightFloats(floats), _mm256_set1_ps(0.5f), _CMP_GE_OQ));
}

/// Whether any of 32 values is NaN or Inf, or all are so large that their sum is: one test for all.
KAGEFUDE_AVX2 bool mayBeUnknown(const uint8_t* floats) {
  const __m256 sum =
      _mm256_add_ps(_mm256_add_ps(eightFloats(floats), eightFloats(floats + 32)),
                    _mm256_add_ps(eightFloats(floats + 64), eightFloats(floats + 96)));
  const __m256 rest = _mm256_sub_ps(sum, sum);  // 0, or NaN
  return _mm256_movemask_ps(_mm256_cmp_ps(rest, rest, _CMP_UNORD_Q)) != 0;
}

KAGEFUDE_AVX2 size_t floatToMask(const uint8_t* floats, size_t n, uint8_t* out) {
  const __m256i order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);  // packing goes by lanes
  size_t i = 0, unknown = 0;
  for (; i + 32 <= n; i += 32) {
    const uint8_t* in = floats + 4 * i;
    if (mayBeUnknown(in)) {
      unknown += plainExrKernels().floatToMask(in, 32, out + i);
      continue;
    }
    const __m256i first = _mm256_packs_epi32(atLeastHalf(in), atLeastHalf(in + 32));
    const __m256i second = _mm256_packs_epi32(atLeastHalf(in + 64), atLeastHalf(in + 96));
    const __m256i bytes = _mm256_permutevar8x32_epi32(_mm256_packs_epi16(first, second), order);
    store(out + i, _mm256_and_si256(bytes, _mm256_set1_epi8(1)));
  }
  return unknown + plainExrKernels().floatToMask(floats + 4 * i, n - i, out + i);
}

/// F16C, which clang 14 does not know by name.
bool convertsHalves() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) && (c & bit_F16C);
}

}  // namespace

const ExrKernels* avx2ExrKernels() {
  static const ExrKernels kernels = {"avx2",  sumBytes,    unpack,      split,
                                     predict, halfToFloat, floatToHalf, floatToMask};
  return __builtin_cpu_supports("avx2") && convertsHalves() ? &kernels : nullptr;
}

}  // namespace kagefude

#else

namespace kagefude {
const ExrKernels* avx2ExrKernels() { return nullptr; }
}  // namespace kagefude

#endif
