#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace kagefude {

/// Makes sure, before a library opens it by name, that `path` is a plain file: a folder, a pipe
/// that nobody writes to or an endless device is refused instead of read as empty, waited for or
/// read without end. Notes it among the files that are read (see files_read.h). Returns its size in
/// bytes. InputError, "FILE cannot be read: …".
uint64_t requirePlainFile(const std::filesystem::path& path);

/// The whole content of a plain file of at most `most` bytes. InputError as above, and when it is
/// larger.
std::string readPlainFile(const std::filesystem::path& path, uint64_t most);

}  // namespace kagefude
