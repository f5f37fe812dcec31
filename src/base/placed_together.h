#pragma once

#include <filesystem>
#include <mutex>
#include <vector>

#include "base/temp_file.h"

namespace kagefude {

/// Files that mean something only together, such as a look and its strips: all come to their places
/// or none does. They are made in `scratch()`, placed one by one, and stay with keep(); without it
/// (an error, an interrupt of the process) each is taken away again and what it replaced comes
/// back. Folders made above the strips' own stay: they are what the caller asked for.
///
///     PlacedTogether files(folder / ".l_strips.new");
///     write(files.scratch() / "a.png");
///     files.place(files.scratch() / "a.png", folder / "l_strips/a.png");
///     files.keep();
///
/// A process that is killed outright may leave some in place, and the scratch folder, which the
/// next one of that name takes away.
class PlacedTogether {
 public:
  /// Makes the scratch folder, on the file system of the targets. OutputError.
  explicit PlacedTogether(std::filesystem::path scratch);
  ~PlacedTogether();
  PlacedTogether(const PlacedTogether&) = delete;
  PlacedTogether& operator=(const PlacedTogether&) = delete;

  const std::filesystem::path& scratch() const { return scratch_; }

  /// Moves a finished file to its place, and makes the target's folder where it is not there. A
  /// symbolic link is replaced by the file. OutputError when something else than a file is there,
  /// or the file system refuses; UsageError when the target was read, see files_read.h.
  void place(const std::filesystem::path& made, const std::filesystem::path& target);
  /// What was placed stays from here on.
  void keep();

 private:
  struct Placed {
    std::filesystem::path target, before;  ///< what stood there, or nothing
  };
  std::filesystem::path setAside(const std::filesystem::path& target);
  void takeBack();
  void end();

  std::mutex mutex_;  ///< an interrupt ends it from another thread
  std::filesystem::path scratch_;
  std::vector<Placed> placed_;
  std::vector<std::filesystem::path> folders_;  ///< that were made for them
  bool ended_ = false;
  CleansAtInterrupt atInterrupt_;
};

}  // namespace kagefude
