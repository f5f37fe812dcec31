#include "base/folders.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"

namespace kagefude {

namespace fs = std::filesystem;

void flushFolder(const fs::path& folder) {
  const int descriptor =
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

void makeFolders(const fs::path& folder, const FlushFolder& flush) {
  std::error_code failed;
  if (folder.empty() || fs::is_directory(folder, failed)) return;
  const fs::path plain = folder.has_filename() ? folder : folder.parent_path();
  if (plain.has_parent_path() && plain.parent_path() != plain)
    makeFolders(plain.parent_path(), flush);
  // Another task may make it at the same time: what counts is that it is there, and on the disk.
  fs::create_directory(plain, failed);
  flush(plain.parent_path());
  if (!fs::is_directory(plain))
    throw OutputError(fmt::format("cannot make the folder {}: {}", folder.string(),
                                  failed ? failed.message() : "a file has its name"));
}

}  // namespace kagefude
