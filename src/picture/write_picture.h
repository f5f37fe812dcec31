#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "image/plane.h"
#include "picture/picture_header.h"

namespace kagefude {

/// The file that a picture takes its metadata from, and which of its parts.
struct MetadataSource {
  std::filesystem::path file;
  int part = 0;
};

/// Writes planes of one size, one a channel of `header`, as a picture through the worker, and that
/// through a temporary: whole or not at all. `header` gives the format, windows, channels (all of
/// one sample type), alpha and attributes. Integers get 0..1, clamped and rounded to the nearest;
/// NaN becomes 0 there. Colours are written as they are, and marked as not multiplied by alpha when
/// the header says so. With `metadata` that file's attributes go along, but for those of its
/// storage and colours, under OpenImageIO's names; the header's win; which of them a format keeps
/// is OpenImageIO's affair. Throws OutputError.
void writePicture(const std::filesystem::path& path, const PictureHeader& header,
                  std::span<const View<const float>> planes,
                  const MetadataSource* metadata = nullptr);

}  // namespace kagefude
