#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "image/plane.h"
#include "picture/picture_header.h"
#include "picture/picture_worker.h"

namespace kagefude {

/// A channel of a picture and the plane that it is read into, of the data window's size. Exactly
/// one view is filled: floats (integers scaled to 0..1), a half's bits, or whole numbers as they
/// are in the file (the bits of a float channel).
struct PicturePlane {
  int channel = 0;
  View<float> values;
  View<uint16_t> halves;
  View<uint32_t> words;
};

/// A picture of any format that OpenImageIO reads, opened. Its claims were checked against its
/// file's size (checkClaim) before anything of that size was allocated; it is one flat picture, and
/// no CMYK. Nothing is turned by its orientation, and colours are as the file has them.
///
/// The constructor throws InputError: no plain file, not a picture, damaged, more pixels than
/// `mostPixels`, deep, a volume, a film or several pages, CMYK, or of a format that is refused by
/// name (a camera's raw file, a medical one).
class PictureFile {
 public:
  explicit PictureFile(const std::filesystem::path& path, int64_t mostPixels = int64_t{1} << 30);

  const PictureHeader& header() const { return header_; }
  /// Decodes the planes. InputError when the file is damaged.
  void read(std::span<const PicturePlane> planes);

 private:
  [[noreturn]] void refuse(const std::string& why) const;
  void check(int64_t mostPixels) const;

  std::filesystem::path path_;
  uint64_t fileBytes_;
  WorkerLease worker_;
  PictureHeader header_;
};

}  // namespace kagefude
