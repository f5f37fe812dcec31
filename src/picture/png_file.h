#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kagefude {

/// A PNG's samples, interleaved, row by row from the top. 1 to 4 channels: grey, grey and alpha,
/// RGB, RGBA; colours are not multiplied by alpha. `bits` is 8 or 16: samples are 0..2^bits - 1.
struct PngPicture {
  int width = 0;
  int height = 0;
  int channels = 0;
  int bits = 8;
  std::vector<uint16_t> samples;
};

/// Reads any PNG; palettes become RGB, fewer than 8 bits become 8, a transparent colour becomes
/// alpha. Throws InputError with the file's name when it is missing, not a PNG, damaged, truncated
/// of an absurd claim (checkClaim, or a chunk that goes beyond the file's end), or of more than
/// `mostPixels`, all before anything of the claimed size is allocated.
PngPicture readPng(const std::filesystem::path& path, int64_t mostPixels = int64_t{1} << 30);

/// The value of a PNG's text chunk of that key ahead of the pixels; nothing when there is none,
/// when the file is no readable PNG, or when it was cut.
std::optional<std::string> readPngText(const std::filesystem::path& path, const std::string& key);

/// The bytes of a PNG marked as sRGB, with text chunks. Throws OutputError when the encoder fails.
std::vector<unsigned char> encodePng(const PngPicture& picture,
                                     const std::map<std::string, std::string>& texts);

}  // namespace kagefude
