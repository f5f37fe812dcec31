#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "exr/image_file.h"
#include "exr/read_channels.h"
#include "image/plane.h"

namespace kagefude {

enum class Compression { none, rle, zips, zip, piz };

/// A channel to be written as `type`. Exactly one of the views is filled, of the data window's
/// size: `values` (stored as half: rounded to nearest, finite values beyond 65,504 held there; as
/// float: as they are), `halves` (bits of a half channel) or `words` (bits of a float or uint one).
struct OutputChannel {
  std::string name;
  PixelType type = PixelType::half;
  View<const float> values;
  View<const uint16_t> halves;
  View<const uint32_t> words;
};

/// Channels from a plane of floats, of ids (stored as uint, bit for bit), and of a passed-through
/// channel (which keeps its type and, if `name` is empty, its name). They keep views, not pixels.
OutputChannel floatChannel(std::string name, PixelType type, View<const float> values);
OutputChannel labelChannel(std::string name, View<const uint32_t> labels);
OutputChannel rawChannel(const RawPlane& plane, std::string name = "");

/// An image to be written. With `source`, all header attributes of the source's first own part that
/// describe the picture (camera, time code, fps, view, Cryptomatte, unknown ones) are carried over
/// bit for bit; those that describe storage are not. With `allParts` those of its other own parts
/// follow: under their names where these are free, as "<part>/<name>" where an earlier part says
/// something else. `attributes` are set after that, as text.
struct OutputImage {
  Window dataWindow;
  Window displayWindow;
  float pixelAspect = 1.0f;
  Compression compression = Compression::zip;
  std::vector<OutputChannel> channels;
  const ImageFile* source = nullptr;
  bool allParts = false;
  std::map<std::string, std::string> attributes;
};

/// Writes an EXR of one part, scanlines, lossless. The file appears under its name whole or not at
/// all: see AtomicFile. Throws OutputError when it cannot be written. Two channels of one name or
/// a plane of the wrong size are errors too.
void writeExr(const std::filesystem::path& path, const OutputImage& image);

/// Writes a PNG of display-ready values: 0..1, clamped, rounded to the nearest of 8 (or 16) bits.
/// `alpha` may be empty; colours are taken as not multiplied by it. `texts` become text chunks
/// (keys of 1 to 79 Latin-1 characters). Appears whole or not at all.
void writePng(const std::filesystem::path& path, View<const float> red, View<const float> green,
              View<const float> blue, View<const float> alpha = {}, int bits = 8,
              const std::map<std::string, std::string>& texts = {});

/// The EXR header that writeExr writes for an image: windows, channels, codec, carried metadata.
Imf::Header makeHeader(const OutputImage& image);

}  // namespace kagefude
