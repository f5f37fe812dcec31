#pragma once

#include <OpenImageIO/imagebuf.h>

#include <filesystem>
#include <string>
#include <vector>

#include "colour/colour.h"
#include "compositor/strip_set.h"
#include "look/look.h"

namespace kagefude {

/// A look with its strips, ready to comp frames in memory; one object serves several threads. What
/// `kagefude comp` does of a file, it does of an ImageBuf, with the same values bit for bit.
class ImageComp {
 public:
  /// Throws InputError or LookError as StripSet and Colour do.
  explicit ImageComp(Look look);
  ImageComp(const ImageComp&) = delete;
  ImageComp& operator=(const ImageComp&) = delete;

  /// Comps a frame: pixels of half, float or uint32, channels named as in its file, masks and data
  /// passes among them. `sidecar` is its JSON; "" takes the one beside the file that the buffer was
  /// read from, if there is one. `warnings` gets one sentence each. The result has the frame's
  /// windows and metadata and float channels R, G, B, A (scene-linear, multiplied by alpha) and the
  /// look's layers, ids as numbers. Throws InputError and LookError.
  OIIO::ImageBuf comp(const OIIO::ImageBuf& frame, int number = 1,
                      const std::filesystem::path& sidecar = "",
                      std::vector<std::string>* warnings = nullptr) const;

 private:
  Look look_;
  Colour colour_;
  StripSet strips_;
};

}  // namespace kagefude
