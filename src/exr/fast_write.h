#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "exr/fast_deflate.h"
#include "exr/fast_types.h"
#include "image/plane.h"
#include "image/window.h"

namespace kagefude {

struct ExrRational {
  int32_t numerator = 0;
  uint32_t denominator = 1;
};

/// Time code as EXR packs it (SMPTE 12M).
struct ExrTimeCode {
  uint32_t timeAndFlags = 0;
  uint32_t userData = 0;
};

/// The value's type decides the attribute's EXR type: int32_t int, float float, double double,
/// string string; arrays of 2 and 3 are v2i/v2f and v3i/v3f, 8 floats chromaticities (red, green,
/// blue, white; x then y), 9 and 16 floats m33f and m44f (row by row, row vectors as Imath);
/// vectors are stringvector and floatvector.
using ExrValue =
    std::variant<int32_t, float, double, std::string, std::array<int32_t, 2>,
                 std::array<int32_t, 3>, std::array<float, 2>, std::array<float, 3>,
                 std::array<float, 8>, std::array<float, 9>, std::array<float, 16>,
                 std::vector<std::string>, std::vector<float>, ExrRational, ExrTimeCode>;

struct ExrAttribute {
  std::string name;
  ExrValue value;
};

/// A channel to be written. Its view has the size of the data window. What a view can be stored as:
/// - View<const float>: float32 bit by bit, or half (nearest, ties to even, as Imath);
/// - View<const uint32_t>: uint32, or float32 whose bits these are (Cryptomatte ids);
/// - View<const uint16_t>: half whose bits these are.
struct ExrSourceChannel {
  std::string name;
  ExrType type = ExrType::float32;
  std::variant<View<const float>, View<const uint32_t>, View<const uint16_t>> pixels;
};

/// A single-part scanline file. The order of channels does not matter.
struct ExrImage {
  Window data;
  Window display;
  float pixelAspect = 1;
  std::array<float, 2> screenWindowCenter = {0, 0};
  float screenWindowWidth = 1;
  std::vector<ExrSourceChannel> channels;
  /// Anything but the attributes that EXR requires (channels, compression, dataWindow,
  /// displayWindow, lineOrder, pixelAspectRatio, screenWindowCenter, screenWindowWidth, type, name,
  /// version, chunkCount, tiles): these follow from the fields above, and naming one is an error.
  std::vector<ExrAttribute> attributes;
  ExrCompression compression = ExrCompression::zip;  ///< none, zips or zip
  ExrEffort effort = ExrEffort::balanced;
};

/// Writes the image to `path`, over whatever is there. Blocks are packed in parallel and written
/// in order; the pixels, and for one processor also the bytes, are the same for any number of
/// threads. Throws OutputError if the image is not one (empty window, wrong view, name twice,
/// reserved attribute) or the file cannot be written (then what was written of it is removed).
/// The caller who wants no partial file under the final name passes a temporary one and renames.
///
/// Memory: a few unpacked and packed blocks a thread.
void writeFastExr(const std::filesystem::path& path, const ExrImage& image);

}  // namespace kagefude
