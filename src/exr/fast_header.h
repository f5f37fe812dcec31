#pragma once

#include <string>

#include "exr/fast_write.h"

struct _priv_exr_context_t;

namespace kagefude {

/// Throws OutputError if the image cannot be written as a file of that name: empty data window, no
/// channels, names missing or given twice, views of wrong size or type, reserved attributes.
void checkExrImage(const std::string& path, const ExrImage& image);

/// Adds the one part with all its attributes to a context that has been started for writing, and
/// writes the header. Throws OutputError.
void writeExrHeader(const std::string& path, _priv_exr_context_t* context, const ExrImage& image);

}  // namespace kagefude
