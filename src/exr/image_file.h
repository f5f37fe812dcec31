#pragma once

#include <OpenEXR/ImfForward.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/window.h"

namespace kagefude {

enum class PixelType { half, single, uint };

/// "half", "float" or "uint".
std::string_view pixelTypeName(PixelType type);

/// One channel of a file. `name` is unique in the file: in a multi-part file a channel without a
/// layer (no dot) takes its part's name as its layer, except in the first part, and so does one
/// whose name an earlier part has used up. `nameInPart` is what the file itself says.
struct Channel {
  std::string name;
  std::string nameInPart;
  PixelType type = PixelType::half;
  int part = 0;
};

/// One part of a file. Files with a single part have one of these, mostly without a name.
struct Part {
  std::string name;
  Window dataWindow;
  std::string compression;  ///< none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab
  bool tiled = false;
};

/// The headers of an EXR file, and nothing of its pixels. The windows, the codec and the metadata
/// are those of the first part; other parts may have other data windows, see `parts`.
struct ImageFile {
  std::filesystem::path path;
  int width = 0;   ///< of the data window
  int height = 0;  ///< of the data window
  Window dataWindow;
  Window displayWindow;
  float pixelAspect = 1.0f;
  std::string compression;
  std::vector<Part> parts;
  std::vector<Channel> channels;  ///< in file order, part by part
  std::shared_ptr<const std::vector<Imf::Header>> headers;

  /// The channel of that exact name, or null.
  const Channel* findChannel(std::string_view name) const;
  /// All channel names, in file order.
  std::vector<std::string> channelNames() const;
  /// A text attribute of any part's header (the first that has it), or nothing.
  std::optional<std::string> text(std::string_view attribute) const;
  /// The names of all text attributes of all parts, sorted, each once.
  std::vector<std::string> textNames() const;
};

/// Reads the headers of all parts of an EXR file. Throws InputError, one sentence with the file's
/// name, when it is missing, not an EXR file, damaged, deep, has subsampled channels, or claims
/// more pixels than its bytes can hold (see checkClaim). Nothing that depends on the claimed size
/// is allocated before that check. Cost: the header, plus 8 bytes a chunk.
ImageFile openImage(const std::filesystem::path& path);

/// Refuses absurd sizes with an InputError: sides of 0 or above 2^17, more than 2^30 pixels, or
/// more raw bytes than the best compression could have packed into `fileBytes` (2,000 to one, where
/// deflate's limit is 1,032; files that claim less than 64 MiB are not worth refusing).
/// `packedWithLoss` (DWA) allows 40,000 to one, for its empty blocks cost next to nothing.
void checkClaim(const std::filesystem::path& path, int64_t width, int64_t height,
                int64_t bytesPerPixel, uint64_t fileBytes, bool packedWithLoss = false);

}  // namespace kagefude
