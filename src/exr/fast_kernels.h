#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kagefude {

/// The last byte of each of the two halves of a zip or rle block, as the predictor left it. EXR
/// stores each byte as its difference to the byte before plus 128; a block starts from 128.
struct ExrCarry {
  uint8_t low = 128;
  uint8_t high = 128;
};

/// Inner loops of the EXR fast path. Every set gives the same bytes; only the speed differs.
///
/// EXR's zip and rle codecs put the even bytes of a block into its first half and the odd bytes
/// into its second half, then replace each byte by its difference to the one before (OpenEXR file
/// layout, "ZIP compression"). All multi-byte values are little-endian.
struct ExrKernels {
  const char* name;

  /// Sum of n bytes modulo 256.
  uint8_t (*sumBytes)(const uint8_t* bytes, size_t n);
  /// Undoes the differences of n bytes of either half and interleaves them: 2n bytes to `out`.
  /// `carry` enters as the bytes before and leaves as the last ones.
  void (*unpack)(const uint8_t* low, const uint8_t* high, size_t n, ExrCarry& carry, uint8_t* out);
  /// Splits n byte pairs into even and odd bytes.
  void (*split)(const uint8_t* pairs, size_t n, uint8_t* low, uint8_t* high);
  /// out[i] = in[i] - in[i-1] + 128 modulo 256, with in[-1] = 128; `in` and `out` do not overlap.
  void (*predict)(const uint8_t* in, size_t n, uint8_t* out);
  /// Exact for every half; the payload of a NaN moves unchanged (signalling ones stay signalling).
  void (*halfToFloat)(const uint16_t* in, size_t n, float* out);
  /// Nearest half, ties to even, overflow to infinity; NaN keeps the top ten bits of its payload,
  /// or gets payload 1 where these are zero. The same as Imath's conversion.
  void (*floatToHalf)(const float* in, size_t n, uint16_t* out);
  /// 1 where one of n floats, which may lie at any address, is at least 0.5, else 0: a hard mask.
  /// NaN and Inf of either sign, of which nothing is known, are 1 (lit: no shadow is made up);
  /// gives how many they are.
  size_t (*floatToMask)(const uint8_t* floats, size_t n, uint8_t* out);
};

/// One value at a time; the oracle of the others, and what runs where there is no AVX2.
const ExrKernels& plainExrKernels();
/// Every set that this processor can run, the plain one first and the fastest last.
std::vector<const ExrKernels*> exrKernelLevels();
/// The fastest of them.
const ExrKernels& fastestExrKernels();

}  // namespace kagefude
