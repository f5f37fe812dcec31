#pragma once

#include <filesystem>

namespace kagefude {

/// Whether a path that a file names stays in that file's folder or below it: not empty, relative,
/// without "..". Paths of other systems (backslashes, a drive letter) and those with a NUL are
/// taken to leave it. Looks at the text alone, so links are followed wherever they lead.
bool staysInFolder(const std::filesystem::path& path);

}  // namespace kagefude
