#pragma once

#include <filesystem>
#include <functional>

namespace kagefude {

/// Flushes the names in a folder to the disk. Some file systems cannot; the files themselves are
/// safe by then, so that is no error.
void flushFolder(const std::filesystem::path& folder);

using FlushFolder = std::function<void(const std::filesystem::path& folder)>;

/// Makes a folder and those above it that are not there, and has the names of each flushed in its
/// parent, the uppermost first: a frame whose folder is lost with the power was not done.
/// OutputError when it cannot be made.
void makeFolders(const std::filesystem::path& folder, const FlushFolder& flush = flushFolder);

}  // namespace kagefude
