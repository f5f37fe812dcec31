#pragma once

#include <cstdint>

namespace kagefude {

/// How a channel's samples are stored in the file.
enum class ExrType { uint32, half, float32 };

/// Lossless codecs that the fast path reads. It writes all but rle.
enum class ExrCompression { none, rle, zips, zip };

/// Bytes of one sample in the file.
constexpr int exrTypeBytes(ExrType type) { return type == ExrType::half ? 2 : 4; }

/// Rows that one chunk of the file holds.
constexpr int exrRowsPerChunk(ExrCompression compression) {
  return compression == ExrCompression::zip ? 16 : 1;
}

}  // namespace kagefude
