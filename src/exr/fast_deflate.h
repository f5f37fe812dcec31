#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

struct libdeflate_compressor;
struct libdeflate_decompressor;

namespace kagefude {

/// What a writer spends on size. All are lossless; without ISA-L all three are `small`. Sizes and
/// speeds are those of noisy 4K colour against OIIO's.
enum class ExrEffort {
  fast,      ///< ISA-L level 1: 4 % larger, ten times as fast
  balanced,  ///< ISA-L level 3: 1 % larger, six times as fast
  small,     ///< libdeflate: the same size, three times as fast
};

/// Inflates zlib streams of known size. One per thread.
class Inflater {
 public:
  Inflater();
  /// True if `packed` holds a whole zlib stream of exactly `size` bytes with the right checksum;
  /// otherwise `out` is undefined, but nothing outside it is touched.
  bool inflate(const uint8_t* packed, size_t packedSize, uint8_t* out, size_t size);

 private:
  struct Free {
    void operator()(libdeflate_decompressor* d) const;
  };
  std::unique_ptr<libdeflate_decompressor, Free> decompressor_;
};

/// Packs blocks into zlib streams. One per thread. Where ISA-L is built in, the packed bytes of
/// `fast` and `balanced` may differ between processors (it picks its own vector code); what they
/// unpack to does not.
class Deflater {
 public:
  explicit Deflater(ExrEffort effort);
  /// Bytes of the zlib stream written to `out`, or 0 if it would not be shorter than `size`.
  /// `out` has room for `size` bytes.
  size_t deflate(const uint8_t* in, size_t size, uint8_t* out);

 private:
  struct Free {
    void operator()(libdeflate_compressor* c) const;
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_;
  std::vector<uint8_t> levelBuffer_;
  uint32_t isalLevel_ = 0;
};

/// Unpacks EXR's run lengths: a count c < 0 is followed by -c bytes as they are, any other by one
/// byte to be repeated c + 1 times. True if exactly `size` bytes came out of all of `packed`.
bool unpackRunLengths(const uint8_t* packed, size_t packedSize, uint8_t* out, size_t size);

}  // namespace kagefude
