#pragma once

#include <span>
#include <string>
#include <vector>

#include "exr/image_file.h"
#include "image/plane.h"
#include "image/sparse_plane.h"

namespace kagefude {

// All readers decode only what is asked for, straight into planes of the file's data window's size
// (its top-left pixel is (0,0)); a channel whose part covers less is 0 around it, a mask 1. All
// throw InputError when a channel does not exist (naming the nearest) or when the file is truncated
// or damaged. An empty list gives an empty result.

/// One plane a name, in the order of the names. half and uint become float; half exactly, uint
/// rounded to the nearest float above 2^24.
std::vector<Floats> readFloats(const ImageFile& file, std::span<const std::string> channelNames);

/// The 32 bits of each pixel of float or uint channels, not converted: for ids. A half channel is
/// an InputError, for its ids are lost.
std::vector<Labels> readBits(const ImageFile& file, std::span<const std::string> channelNames);

/// Whole numbers such as IndexOB: uint as it is, half and float rounded to the nearest; negative,
/// NaN and above 2^32 - 1 give 0, the background.
Labels readIndices(const ImageFile& file, const std::string& channelName);

/// A channel in the type it has in the file, bit for bit, to be passed through to an output. Half
/// channels fill `halves`, float and uint channels `words`; the other plane is empty.
struct RawPlane {
  std::string name;
  PixelType type = PixelType::half;
  Plane<uint16_t> halves;
  Plane<uint32_t> words;
};
std::vector<RawPlane> readRaw(const ImageFile& file, std::span<const std::string> channelNames);

/// A channel and the plane it goes to: `pixels` has room for its part's whole data window, of
/// 2 bytes a pixel when `type` is half, else 4. `type` is the channel's own, or single.
struct PlaneTarget {
  const Channel* channel = nullptr;
  PixelType type = PixelType::single;
  void* pixels = nullptr;
  /// Then a pixel is a byte, 1 where the channel's value is at least 0.5, NaN or Inf, else 0. A
  /// PartSource never sees such a target.
  bool mask = false;
  size_t* unknown = nullptr;  ///< of a mask: here the number of its NaN and Inf is added
  /// Then pixels go there, as `type`, which has 4 bytes. A PartSource never sees such a target.
  SparsePlane* sparse = nullptr;
};

/// Collects channels of one frame so that each chunk of the file is decoded once for all of them.
/// Each call makes the plane and notes it; read() fills all. Planes may be moved in between (their
/// pixels stay where they are) but must live until then. Errors are those of the functions above;
/// asking for a channel twice, in whatever form, is allowed.
class ChannelReader {
 public:
  explicit ChannelReader(const ImageFile& file) : file_(file) {}
  void floats(const std::string& channelName, Floats& plane);
  void bits(const std::string& channelName, Labels& plane);
  /// The same of channels that are 0 nearly everywhere. The plane must stay where it is.
  void sparseFloats(const std::string& channelName, SparsePlane& plane);
  void sparseBits(const std::string& channelName, SparsePlane& plane);
  void raw(const std::string& channelName, RawPlane& plane);
  /// A hard mask: 1 where the channel is at least 0.5, else 0. Where it is NaN or Inf, and beyond
  /// its part's window, nothing is known: that is 1, lit, for no shadow shall be made up. read()
  /// sets `unknown`, which must live until then, to the number of its NaN and Inf.
  void mask(const std::string& channelName, Bytes& plane, size_t& unknown);
  void read();
  const ImageFile& file() const { return file_; }

 private:
  const ImageFile& file_;
  std::vector<PlaneTarget> targets_;
};

/// Index plane of float values: rounded to the nearest; negative, NaN and above 2^32 - 1 give 0.
Labels roundIndices(View<const float> values);

/// Decodes all targets, each in its own part's window; the one place where pixels of frames are
/// read. Throws InputError.
void readPlanes(const ImageFile& file, std::span<const PlaneTarget> targets);

}  // namespace kagefude
