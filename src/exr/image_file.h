#pragma once

#include <OpenEXR/ImfForward.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/window.h"

namespace kagefude {

enum class PixelType { half, single, uint };

/// "half", "float" or "uint".
std::string_view pixelTypeName(PixelType type);

/// One channel of a file. `name` is unique in the file: in a file of several parts a channel
/// without a layer (no dot) takes its part's name, less its view, as its layer, and so does one
/// whose name several parts have. Where a part's header names another view than the first part's,
/// the view stands before the last component ("N.right.X"), as in a file of one part. `nameInPart`
/// is what the file itself says.
struct Channel {
  std::string name;
  std::string nameInPart;
  PixelType type = PixelType::half;
  int part = 0;
};

struct PlaneTarget;

/// Reads the pixels of a part that is no EXR's; see picture/frame_picture.h.
class PlaneSource {
 public:
  virtual ~PlaneSource() = default;
  /// Fills planes of the part's own window. Throws InputError.
  virtual void read(std::span<const PlaneTarget> targets) const = 0;
};

/// One part of a file. Files with a single part have one of these, mostly without a name.
struct Part {
  std::string name;
  std::string view;  ///< as its header says; "" when it says nothing
  Window dataWindow;
  std::string compression;  ///< none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab
  bool tiled = false;
  std::filesystem::path file;                 ///< that holds it
  int place = 0;                              ///< among the parts of that file
  std::shared_ptr<const PlaneSource> source;  ///< what reads it; null: it is an EXR's
  bool ofIntegers = false;  ///< of a picture whose samples are integers: 0..1 in steps
  bool straight = false;    ///< of a picture whose colours are not multiplied by its alpha
};

/// The headers of an EXR file, and nothing of its pixels. The display window, the codec and the
/// metadata are those of the first part that belongs to it; the data window covers those of all
/// that do, for parts may be cropped each to its own (see `parts`).
struct ImageFile {
  std::filesystem::path path;
  int width = 0;   ///< of the data window
  int height = 0;  ///< of the data window
  Window dataWindow;
  Window displayWindow;
  float pixelAspect = 1.0f;
  std::string compression;
  std::vector<Part> parts;
  std::vector<Channel> channels;   ///< in file order, part by part
  std::vector<int> ownParts;       ///< parts whose channels and headers count, in order
  std::vector<std::string> views;  ///< after takeView: all that the file has, the default first
  std::string view;                ///< after takeView: the one that this is; "" without views
  bool viewTaken = false;          ///< names hold no view any more
  std::shared_ptr<const std::vector<Imf::Header>> headers;

  /// The channel of that exact name, or null.
  const Channel* findChannel(std::string_view name) const;
  /// All channel names, in file order.
  std::vector<std::string> channelNames() const;
  /// A text attribute of any own part's header (the first that has it), or nothing.
  std::optional<std::string> text(std::string_view attribute) const;
  /// The same of one part, without looking at the others.
  std::optional<std::string> textOfPart(int part, std::string_view attribute) const;
  /// The names of all text attributes of one part, sorted.
  std::vector<std::string> textNames(int part) const;
  /// The header whose metadata an output carries on: the first own part's.
  const Imf::Header& leadingHeader() const;
};

/// Reads the headers of all parts of an EXR file. Throws InputError, one sentence with the file's
/// name, when it is missing, not an EXR file, damaged, deep, has subsampled channels, or claims
/// more pixels than its bytes can hold (see checkClaim), in a part or in the window that joins
/// them, or tiles beyond the picture and 64 MiB. Nothing of a claimed size is allocated before.
/// Cost: the header, plus 8 bytes a chunk.
ImageFile openImage(const std::filesystem::path& path);

/// Several files of one frame as one image whose parts are theirs, in that order. Of a file of one
/// part `layers` gives the layer of channels that have none ("" leaves them bare), as a part's name
/// does; where two channels have one name, the later one is numbered. The path is the first one's.
/// Throws InputError when the display windows differ, or the joined window is absurd (checkClaim).
ImageFile joinImages(std::vector<ImageFile> images, const std::vector<std::string>& layers);

/// Sets the data window to what covers the own parts' windows, and what is the first own part's.
void describeOwnParts(ImageFile& file);

/// Refuses absurd sizes with an InputError: sides of 0 or above 2^17, more than 2^30 pixels, or
/// more raw bytes than the best compression could have packed into `fileBytes` (2,000 to one, where
/// deflate's limit is 1,032; files that claim less than 64 MiB are not worth refusing).
/// `packedWithLoss` (DWA) allows 40,000 to one, for its empty blocks cost next to nothing.
void checkClaim(const std::filesystem::path& path, int64_t width, int64_t height,
                int64_t bytesPerPixel, uint64_t fileBytes, bool packedWithLoss = false);

}  // namespace kagefude
