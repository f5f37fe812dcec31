#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "look/look_sections.h"

namespace kagefude {

/// The style that holds for a surface: of those that match the one of the highest priority, of
/// equal ones the first in the file; null when none matches.
const StyleLook* chooseStyle(const std::vector<StyleLook>& styles,
                             const std::function<bool(const StyleParams&)>& matches);

/// Reads a look file and lays `overrides` ("section.key=value", also "style[0].brush.key=value")
/// over it. An empty path gives the defaults. Throws LookError with file:line.
Look readLook(const std::filesystem::path& path, const std::vector<std::string>& overrides);

/// The same of a text that stands (or will stand) in the file `path`.
Look readLookText(std::string_view text, const std::filesystem::path& path,
                  const std::vector<std::string>& overrides);

/// The bytes of a look's file. Throws LookError.
std::string readLookFile(const std::filesystem::path& path);

/// The look as TOML with all values resolved, in a fixed order: what a report shows and what a
/// fingerprint is made of.
std::string resolvedText(const Look& look);

}  // namespace kagefude
