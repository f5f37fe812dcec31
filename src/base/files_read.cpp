#include "base/files_read.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <mutex>

#include "base/error.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

std::optional<std::pair<uint64_t, uint64_t>> identityOf(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return std::pair(static_cast<uint64_t>(status.st_dev), static_cast<uint64_t>(status.st_ino));
}

/// Belongs to the process as its temporaries do: readers and writers know nothing of each other.
struct Read {
  std::mutex mutex;
  int guards = 0;
  FileSet files;
};

Read& filesRead() {
  static Read read;
  return read;
}

thread_local bool looksAtOutputs = false;

}  // namespace

void FileSet::add(const fs::path& file) {
  if (const auto identity = identityOf(file)) members_.emplace(*identity, fs::absolute(file));
}

std::optional<fs::path> FileSet::find(const fs::path& file) const {
  const auto identity = identityOf(file);
  if (!identity) return std::nullopt;
  const auto found = members_.find(*identity);
  if (found == members_.end() || identityOf(found->second) != identity) return std::nullopt;
  return found->second;
}

FilesReadGuard::FilesReadGuard() {
  std::lock_guard lock(filesRead().mutex);
  ++filesRead().guards;
}

FilesReadGuard::~FilesReadGuard() {
  std::lock_guard lock(filesRead().mutex);
  if (--filesRead().guards == 0) filesRead().files = FileSet();
}

LooksAtOutputs::LooksAtOutputs() : before_(looksAtOutputs) { looksAtOutputs = true; }
LooksAtOutputs::~LooksAtOutputs() { looksAtOutputs = before_; }

void noteFileRead(const fs::path& file) {
  if (looksAtOutputs) return;
  Read& read = filesRead();
  std::lock_guard lock(read.mutex);
  if (read.guards > 0) read.files.add(file);
}

void refuseToOverwriteRead(const fs::path& output) {
  Read& read = filesRead();
  std::lock_guard lock(read.mutex);
  if (const auto file = read.files.find(output))
    throw UsageError(fmt::format("the output {} would overwrite {}, which is read", output.string(),
                                 file->string()));
}

}  // namespace kagefude
