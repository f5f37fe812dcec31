#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <utility>

namespace kagefude {

/// Files by what they are and not by what they are called: two names of one file (links, `..`,
/// other mounts of one disk) are one member. A file that is not there is no member.
class FileSet {
 public:
  void add(const std::filesystem::path& file);
  /// The name under which the file behind `file` was added. A member that was replaced or removed
  /// since then is none: its number may name another file by now.
  std::optional<std::filesystem::path> find(const std::filesystem::path& file) const;

 private:
  std::map<std::pair<uint64_t, uint64_t>, std::filesystem::path> members_;  ///< by device and inode
};

/// Files that are read are never written: while one of these lives (one per command), every file
/// that the readers open is noted, and a TempFile for one of them is refused. Without one nothing
/// is noted, so that code which writes a file, reads it and writes it again is free to.
class FilesReadGuard {
 public:
  FilesReadGuard();
  ~FilesReadGuard();
  FilesReadGuard(const FilesReadGuard&) = delete;
  FilesReadGuard& operator=(const FilesReadGuard&) = delete;
};

/// What this thread opens while one of these lives is an output of an earlier run that is only
/// looked at (is it up to date?) and may be written anew.
class LooksAtOutputs {
 public:
  LooksAtOutputs();
  ~LooksAtOutputs();
  LooksAtOutputs(const LooksAtOutputs&) = delete;
  LooksAtOutputs& operator=(const LooksAtOutputs&) = delete;

 private:
  bool before_;
};

/// Called by every reader. Cost: one system call.
void noteFileRead(const std::filesystem::path& file);

/// UsageError when `output` is a file that was read.
void refuseToOverwriteRead(const std::filesystem::path& output);

}  // namespace kagefude
