#pragma once

#include <filesystem>

namespace kagefude {

/// Makes a folder and those above it, and flushes each new name to the disk: a frame whose folder
/// is lost with the power was not done. OutputError when it cannot be made.
void makeFolders(const std::filesystem::path& folder);

/// Flushes the names in a folder to the disk. Some file systems cannot; the files themselves are
/// safe by then, so that is no error.
void flushFolder(const std::filesystem::path& folder);

}  // namespace kagefude
