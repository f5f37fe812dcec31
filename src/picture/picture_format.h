#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace kagefude {

/// What an output's samples are, in OpenImageIO's words.
enum class SampleDepth { automatic, half, single, uint8, uint10, uint12, uint16 };
inline constexpr std::string_view sampleDepthNames[] = {"auto",   "half",   "float", "uint8",
                                                        "uint10", "uint12", "uint16"};

constexpr std::string_view sampleDepthName(SampleDepth depth) {
  return sampleDepthNames[static_cast<size_t>(depth)];
}

/// Integers hold what a display shows; floats hold scene-linear light.
constexpr bool isDisplayReferred(SampleDepth depth) { return depth >= SampleDepth::uint8; }

/// Most that a sample of integers holds, 255 for uint8.
int mostOf(SampleDepth depth);

/// What a format does with alpha: has none, colours multiplied by it, or by themselves.
enum class FormatAlpha { none, associated, straight };

/// A format that frames are written in, whole: its suffixes, help, checks and samples come from its
/// row in pictureFormats().
struct PictureFormat {
  std::string_view name;  ///< OpenImageIO's
  std::array<std::string_view, 2> suffixes;
  FormatAlpha alpha = FormatAlpha::none;
  std::array<SampleDepth, 4> depths;  ///< the usual one first; automatic where there are fewer
  int longestSide = 1 << 17;          ///< pixels that its headers can say

  bool isExr() const { return name == "openexr"; }
};

std::span<const PictureFormat> pictureFormats();

/// Every suffix that outputs may have: ".exr, .tif, ...".
std::string listSuffixes();

/// The format that a file's suffix names, in any case. `option` is what the user wrote the file
/// after. Throws UsageError that lists the suffixes.
const PictureFormat& formatOf(const std::filesystem::path& file, std::string_view option);

/// What becomes of alpha at a depth. OpenImageIO 2.4 loses the end of rows of DPX's three samples
/// of 10 bits a word when pixels have four; other programs expect none there either.
FormatAlpha alphaFor(const PictureFormat& format, SampleDepth depth);

/// The depth to write, `asked` or the format's usual one. Throws LookError when it holds no such.
SampleDepth depthFor(const PictureFormat& format, SampleDepth asked);

}  // namespace kagefude
