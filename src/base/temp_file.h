#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kagefude {

/// Makes an output appear under its final name at once or not at all: the caller writes to
/// `path()`, an empty file created beside the target, then calls commit(). Without commit() the
/// destructor removes the temporary, so an exception leaves nothing behind.
///
///     TempFile file("out/shot.0001.exr");
///     writeEverythingTo(file.path());   // closes its handle
///     file.commit();
///
/// The temporary is `.NAME.kagefude-HOST-PID-N.tmp` in the target's folder, so renaming never
/// crosses file systems, and removeLeftovers() recognises those of a killed run. It does not end in
/// the target's extension: writers that choose the format by name must be told the format. A target
/// that is a symbolic link is replaced by the file.
///
/// Every live temporary is known to the process, so that an interrupt can remove them all
/// (removeLiveTempFiles). Thread-safe.
class TempFile {
 public:
  /// Creates the empty temporary. OutputError when the folder is missing or read-only, when the
  /// target is something else than a regular file (a folder, a device, an open descriptor's link),
  /// or after removeLiveTempFiles(). UsageError when the target is a file that was read, see
  /// files_read.h.
  explicit TempFile(std::filesystem::path target);
  ~TempFile();
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& target() const { return target_; }

  /// Flushes the file's contents to the disk and renames it to the target, replacing an older one.
  /// OutputError (full disk, folder gone) leaves the older one as it was. Call it once, after every
  /// handle on the file is closed. The first one in a folder also removes the leftovers there.
  void commit();

 private:
  void rename();

  std::filesystem::path target_;
  std::filesystem::path path_;
  int lock_ = -1;  ///< open and locked while the file is written: the proof that its writer lives
  bool live_ = false;
};

/// Writes `contents` to `target` through a TempFile. OutputError as there, and on a full disk.
void writeFileAtomically(const std::filesystem::path& target, std::string_view contents);

/// What a temporary's name says.
struct TempName {
  std::string target;  ///< file name of the output; cut at the end when it was very long
  std::string host;
  long pid = 0;
};

/// The parts of a temporary's file name, or nothing when it is not one of ours.
std::optional<TempName> parseTempName(std::string_view fileName);

/// Removes the temporaries in `folder` that no living run owns. A writer holds a lock on its file,
/// which ends with it however it ends, so a run that is only suspended keeps its files, and so it
/// does when a clock is off. What other hosts have left goes too, where locks reach from host to
/// host, once it was not touched for a quarter of an hour; elsewhere it waits for a run on its own
/// host. Returns the removed paths, sorted. A missing folder has none; files that cannot be removed
/// are left.
std::vector<std::filesystem::path> removeLeftovers(const std::filesystem::path& folder);

/// What else an interrupt has to clean: while one of these lives, removeLiveTempFiles calls `clean`
/// as well, from another thread. It must not make or commit a TempFile.
class CleansAtInterrupt {
 public:
  explicit CleansAtInterrupt(std::function<void()> clean);
  ~CleansAtInterrupt();
  CleansAtInterrupt(const CleansAtInterrupt&) = delete;
  CleansAtInterrupt& operator=(const CleansAtInterrupt&) = delete;
};

/// Removes every live temporary of this process and refuses new ones and commits from then on. For
/// a process that is about to exit, callable from any thread while others still write.
void removeLiveTempFiles() noexcept;

}  // namespace kagefude
