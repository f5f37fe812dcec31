#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "exr/fast_types.h"
#include "image/plane.h"
#include "image/sparse_plane.h"
#include "image/window.h"

struct _priv_exr_context_t;

namespace kagefude {

/// A channel as the header lists it.
struct ExrChannel {
  std::string name;
  ExrType type = ExrType::float32;
};

/// What the header says of one part (OIIO's subimage of the same number).
struct ExrPart {
  std::string name;  ///< empty where a single-part file has none
  Window data;
  Window display;
  ExrCompression compression = ExrCompression::none;
  std::vector<ExrChannel> channels;  ///< in the order of the file, which is sorted by name
  /// False for what the fast path leaves to others: tiles, deep data, lossy codecs and piz,
  /// subsampled channels, lines stored from bottom to top. Then only `name` is set.
  bool readable = false;

  /// Index of the channel of that name, or -1.
  int channelIndex(const std::string& name) const;
};

/// Where to put one channel. Its view has the size of the part's data window.
/// - View<float>: float samples bit by bit, half samples exactly (NaN payloads included), uint
///   samples rounded to the nearest float.
/// - View<uint32_t>: the bits of float (Cryptomatte ids) or uint samples.
/// - View<uint16_t>: the bits of half samples.
/// - View<uint8_t>: a hard mask of any samples, 1 where they are at least 0.5, NaN or Inf, else 0.
struct ExrTarget {
  int channel = 0;
  std::variant<View<float>, View<uint32_t>, View<uint16_t>, View<uint8_t>> pixels;
  size_t* unknown = nullptr;  ///< of a mask: here the number of NaN and Inf is added
  /// Then the pixels of a View<float> or View<uint32_t> go there, and the view gives their size.
  SparsePlane* sparse = nullptr;
};

/// A scanline EXR file of lossless zip, zips, rle or no compression, read straight into planes:
/// chunks in parallel, each inflated once, channels that nobody asked for skipped. Gives the same
/// pixels as OIIO (which quiets signalling NaNs of half channels; here their bits stay).
///
/// The file is taken for hostile: sizes are checked against the length of the file before anything
/// is allocated, and a damaged chunk is an InputError, never a crash. Reads are deterministic, the
/// error too: it names the topmost damaged chunk.
class FastExr {
 public:
  /// Nothing if no part of the file is readable in this way (not an EXR, missing, broken header,
  /// tiles only, ...): then OIIO shall read it, or say what is wrong. Throws InputError if a
  /// readable part claims more pixels than a file of this length can hold.
  static std::optional<FastExr> open(const std::filesystem::path& path);

  const std::vector<ExrPart>& parts() const { return parts_; }

  /// Reads the chosen channels of a readable part. A channel may be asked for more than once, but
  /// views must not overlap. Throws InputError for damaged or missing chunks, for a view of wrong
  /// size or a type that cannot hold the samples.
  ///
  /// Cost: one inflate of the part whatever the channels; memory of one packed and one inflated
  /// chunk a thread.
  void read(int part, std::span<const ExrTarget> targets) const;
  /// The same into new float planes, in the order of `channels`.
  std::vector<Floats> readFloats(int part, std::span<const int> channels) const;

 private:
  struct Close {
    void operator()(_priv_exr_context_t* context) const;
  };
  FastExr() = default;
  std::string path_;
  std::unique_ptr<_priv_exr_context_t, Close> context_;
  std::vector<ExrPart> parts_;
};

}  // namespace kagefude
