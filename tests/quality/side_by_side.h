#pragma once

#include <string>

#include "image/plane.h"

namespace kagefude {

/// Writes a labelled PNG of three pictures side by side: `ours`, `truth` (shares in shadow; black
/// is full shadow, truth below 0 is background), and their difference, sixteen times as strong in
/// red. Pixels where `leftOut` is not 0 are grey in the difference.
void writeSideBySide(const std::string& path, const std::string& method, View<const float> ours,
                     View<const float> truth, View<const uint8_t> leftOut);

}  // namespace kagefude
