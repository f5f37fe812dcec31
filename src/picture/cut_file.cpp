#include "picture/cut_file.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "picture/cut_tiff.h"

namespace kagefude {
namespace {

std::string bytesAt(const std::filesystem::path& path, uint64_t place, size_t count) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(place));
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<size_t>(file.gcount()));
  return bytes;
}

uint64_t bigEndian(const std::string& bytes) {
  uint64_t number = 0;
  for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

/// Coded pixels hold no end-of-image marker, so that a cut file has none near its end (ITU-T T.81,
/// B.1.1.5); what cameras append has markers of its own.
bool jpegHasNoEnd(const std::filesystem::path& path, uint64_t fileBytes) {
  constexpr uint64_t tail = 1 << 16;
  const uint64_t from = fileBytes - std::min(fileBytes, tail);
  return bytesAt(path, from, tail).find("\xFF\xD9") == std::string::npos;
}

/// A PNG ends with an empty IEND chunk and its check sum; a little may be appended.
bool pngHasNoEnd(const std::filesystem::path& path, uint64_t fileBytes) {
  constexpr uint64_t tail = 1 << 16;
  const uint64_t from = fileBytes - std::min(fileBytes, tail);
  return bytesAt(path, from, tail).find("IEND\xAE\x42\x60\x82") == std::string::npos;
}

/// The first chunk holds all others and says how long it is.
bool iffIsShort(const std::filesystem::path& path, uint64_t fileBytes) {
  return bigEndian(bytesAt(path, 4, 4)) + 8 > fileBytes;
}

/// The header is 128 bytes; blocks of 16 pixels take 8 bytes at least, plain pixels all of theirs.
bool ddsIsShort(const PictureHeader& header, uint64_t fileBytes) {
  const auto pixels = static_cast<uint64_t>(header.dataWindow.pixels());
  const bool plain = header.text("compression").empty();
  return fileBytes < 128 + (plain ? pixels * header.channels.size() : pixels / 2);
}

/// A film's picture: the file's size is in its header at `place`, in the byte order that the magic
/// number has, which begins with `turned` where it is turned; all ones mean that it was not filled
/// in.
bool filmIsShort(const std::filesystem::path& path, uint64_t fileBytes, uint64_t place,
                 const char* turned) {
  std::string size = bytesAt(path, place, 4);
  if (bytesAt(path, 0, 1) == turned) std::reverse(size.begin(), size.end());
  const uint64_t said = bigEndian(size);
  return said != 0xFFFFFFFF && said > fileBytes;
}

}  // namespace

bool isCutShort(const std::filesystem::path& path, const PictureHeader& header,
                uint64_t fileBytes) {
  if (header.format == "tiff") return tiffIsCutShort(path, fileBytes);
  if (header.format == "jpeg") return jpegHasNoEnd(path, fileBytes);
  if (header.format == "png") return pngHasNoEnd(path, fileBytes);
  if (header.format == "iff") return iffIsShort(path, fileBytes);
  if (header.format == "dds") return ddsIsShort(header, fileBytes);
  if (header.format == "dpx") return filmIsShort(path, fileBytes, 16, "X");
  return header.format == "cineon" && filmIsShort(path, fileBytes, 20, "\xD7");
}

}  // namespace kagefude
