#include "base/temp_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <map>
#include <mutex>
#include <set>

#include "base/error.h"
#include "base/files_read.h"
#include "base/folders.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".kagefude-";
constexpr std::string_view kEnd = ".tmp";
constexpr size_t kLongestName = 255;  // NAME_MAX of the usual file systems
constexpr auto kAbandonedAfter = std::chrono::minutes(15);

/// The one piece of state that belongs to the process: an interrupt must find the files that other
/// threads are writing, whoever opened them.
struct LiveFiles {
  std::mutex mutex;
  std::set<fs::path> paths;
  std::set<fs::path> cleaned;  ///< folders that were looked through for leftovers
  std::map<const CleansAtInterrupt*, std::function<void()>> cleaners;
  unsigned long created = 0;
  bool closed = false;
};

LiveFiles& liveFiles() {
  static LiveFiles files;
  return files;
}

/// Host name, and the process-id namespace beside it: containers may share the first, and then a
/// process id of one means nothing in the other.
std::string hostToken() {
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0) std::strcpy(name, "unknown");
  std::string token(name);
  std::error_code failed;
  const std::string space = fs::read_symlink("/proc/self/ns/pid", failed).string();
  if (!failed) token += "-" + space;
  std::erase_if(token, [](unsigned char c) { return !std::isalnum(c) && c != '-'; });
  return token.substr(0, 96);
}

fs::path folderOf(const fs::path& target) {
  const fs::path folder = target.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

std::string tempName(const std::string& target, unsigned long number) {
  const std::string tail =
      fmt::format("{}{}-{}-{}{}", kMark, hostToken(), static_cast<long>(getpid()), number, kEnd);
  return fmt::format(".{}{}", target.substr(0, kLongestName - 1 - tail.size()), tail);
}

std::string reason(int error) { return std::strerror(error); }

void flushToDisk(const fs::path& path, const fs::path& target) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int openError = errno;
  if (file < 0)
    throw OutputError(fmt::format("cannot finish {}: its temporary file: {}", target.string(),
                                  reason(openError)));
  const int failed = fsync(file) != 0 ? errno : 0;
  close(file);
  // Some network and memory file systems have no fsync; they say so and lose nothing by it.
  if (failed != 0 && failed != EINVAL && failed != ENOTSUP)
    throw OutputError(fmt::format("cannot write {}: {}", target.string(), reason(failed)));
}

bool processIsGone(long pid) { return kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH; }

enum class Lock { free, held, unknown };

/// Takes the lock that a temporary's writer holds for as long as it lives.
Lock takeLock(int file) {
  if (flock(file, LOCK_EX | LOCK_NB) == 0) return Lock::free;
  return errno == EWOULDBLOCK ? Lock::held : Lock::unknown;
}

/// Whether locks taken on another machine, or in another container, are seen here. Network file
/// systems that hand them to the server do that; of the others each machine sees its own.
bool locksReachOthers(int file) {
  struct statfs system {};
  if (fstatfs(file, &system) != 0) return false;
  constexpr unsigned long ownOnly[] = {0xFF534D42, 0xFE534D42, 0x517B,    0x65735546,
                                       0x0BD00BD0, 0x47504653, 0x01021997};
  const auto type = static_cast<unsigned long>(system.f_type) & 0xFFFFFFFF;
  return std::find(std::begin(ownOnly), std::end(ownOnly), type) == std::end(ownOnly);
}

bool isOld(const fs::path& path) {
  std::error_code failed;
  const auto touched = fs::last_write_time(path, failed);
  return !failed && fs::file_time_type::clock::now() - touched > kAbandonedAfter;
}

/// Whether nobody will finish the temporary that `file` is open on. Age is no proof of that: a
/// suspended task may wake up. A writer holds a lock on its file until it ends, however it ends.
bool isAbandoned(int file, const fs::path& path, const TempName& name) {
  const bool ownHost = name.host == hostToken();
  if (ownHost && name.pid == getpid()) {
    std::lock_guard lock(liveFiles().mutex);
    return !liveFiles().paths.contains(path);
  }
  switch (takeLock(file)) {
    case Lock::held:
      return false;
    case Lock::free:
      return ownHost || (locksReachOthers(file) && isOld(path));
    case Lock::unknown:
      break;
  }
  return ownHost && processIsGone(name.pid);
}

/// A name in a folder where frames are made: never that of a device or of an open file, which
/// the rename would replace (`/dev/stdout` is a link).
void refuseSystemFolders(const fs::path& target, const fs::path& folder) {
  const std::string place = folder.string();
  if (place == "/dev" || place.starts_with("/proc/") || place == "/proc")
    throw OutputError(fmt::format("cannot write {}: it is not a regular file", target.string()));
}

/// Whether nothing was finished in this folder before: then it is looked through for leftovers.
bool firstIn(const fs::path& folder) {
  std::lock_guard lock(liveFiles().mutex);
  return liveFiles().cleaned.insert(folder).second;
}

void writeAll(const fs::path& path, std::string_view contents, const fs::path& target) {
  const int file = open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  int failed = file < 0 ? errno : 0;
  while (failed == 0 && !contents.empty()) {
    const ssize_t written = write(file, contents.data(), contents.size());
    if (written >= 0) {
      contents.remove_prefix(static_cast<size_t>(written));
    } else if (errno != EINTR) {
      failed = errno;
    }
  }
  if (file >= 0 && close(file) != 0 && failed == 0) failed = errno;
  if (failed != 0)
    throw OutputError(fmt::format("cannot write {}: {}", target.string(), reason(failed)));
}

}  // namespace

TempFile::TempFile(fs::path target) : target_(std::move(target)) {
  refuseToOverwriteRead(target_);
  std::error_code ignored;
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw OutputError(fmt::format("cannot write {}: it is not a regular file", target_.string()));
  if (!target_.has_filename())
    throw OutputError(fmt::format("cannot write '{}': it names no file", target_.string()));

  LiveFiles& live = liveFiles();
  std::lock_guard lock(live.mutex);
  if (live.closed)
    throw OutputError(fmt::format("did not write {}: interrupted", target_.string()));
  std::error_code missing;
  fs::path folder = fs::canonical(folderOf(target_), missing);
  if (missing) folder = folderOf(target_);
  refuseSystemFolders(target_, folder);
  int error = EEXIST;
  while (lock_ < 0 && error == EEXIST) {
    path_ = folder / tempName(target_.filename().string(), live.created++);
    lock_ = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    error = errno;
    if (lock_ < 0) continue;
    // Whoever looked for leftovers before the lock was there has taken the file away, or will.
    struct stat status {};
    if (takeLock(lock_) != Lock::held && fstat(lock_, &status) == 0 && status.st_nlink > 0) break;
    unlink(path_.c_str());
    close(lock_);
    lock_ = -1;
    error = EEXIST;
  }
  if (lock_ < 0)
    throw OutputError(fmt::format("cannot write {}: folder {}: {}", target_.string(),
                                  folderOf(target_).string(), reason(error)));
  live.paths.insert(path_);
  live_ = true;
}

TempFile::~TempFile() {
  if (!live_) return;
  LiveFiles& live = liveFiles();
  std::lock_guard lock(live.mutex);
  unlink(path_.c_str());
  live.paths.erase(path_);
  close(lock_);
}

void TempFile::commit() {
  flushToDisk(path_, target_);
  rename();
  const fs::path folder = folderOf(target_);
  flushFolder(folder);
  if (firstIn(path_.parent_path())) removeLeftovers(folder);
}

void TempFile::rename() {
  LiveFiles& live = liveFiles();
  std::lock_guard lock(live.mutex);
  if (live.closed)
    throw OutputError(fmt::format("did not write {}: interrupted", target_.string()));
  if (std::rename(path_.c_str(), target_.c_str()) != 0)
    throw OutputError(fmt::format("cannot write {}: {}", target_.string(), reason(errno)));
  live.paths.erase(path_);
  live_ = false;
  close(lock_);
}

void writeFileAtomically(const fs::path& target, std::string_view contents) {
  TempFile file(target);
  writeAll(file.path(), contents, target);
  file.commit();
}

std::optional<TempName> parseTempName(std::string_view fileName) {
  if (!fileName.starts_with('.') || !fileName.ends_with(kEnd)) return std::nullopt;
  const size_t mark = fileName.rfind(kMark);
  if (mark == std::string_view::npos || mark < 2) return std::nullopt;
  std::string_view owner = fileName.substr(mark + kMark.size());
  owner.remove_suffix(kEnd.size());
  const size_t numberAt = owner.rfind('-');
  if (numberAt == std::string_view::npos || numberAt == 0) return std::nullopt;
  const size_t pidAt = owner.rfind('-', numberAt - 1);
  if (pidAt == std::string_view::npos || pidAt == 0) return std::nullopt;

  const auto parse = [](std::string_view digits) {
    long value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && end == digits.data() + digits.size() ? value : -1;
  };
  const long pid = parse(owner.substr(pidAt + 1, numberAt - pidAt - 1));
  if (pid <= 0 || parse(owner.substr(numberAt + 1)) < 0) return std::nullopt;
  return TempName{std::string(fileName.substr(1, mark - 1)), std::string(owner.substr(0, pidAt)),
                  pid};
}

std::vector<fs::path> removeLeftovers(const fs::path& folder) {
  std::vector<fs::path> removed;
  std::error_code failed;
  const fs::path place = fs::canonical(folder.empty() ? "." : folder, failed);
  if (failed) return removed;
  for (fs::directory_iterator entry(place, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const auto name = parseTempName(entry->path().filename().string());
    if (!name) continue;
    const int file = open(entry->path().c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) continue;
    // Removed before the lock that proves its end is given back.
    if (isAbandoned(file, entry->path(), *name) && unlink(entry->path().c_str()) == 0)
      removed.push_back(entry->path());
    close(file);
  }
  std::sort(removed.begin(), removed.end());
  return removed;
}

CleansAtInterrupt::CleansAtInterrupt(std::function<void()> clean) {
  const std::lock_guard lock(liveFiles().mutex);
  liveFiles().cleaners.emplace(this, std::move(clean));
}

CleansAtInterrupt::~CleansAtInterrupt() {
  const std::lock_guard lock(liveFiles().mutex);
  liveFiles().cleaners.erase(this);
}

void removeLiveTempFiles() noexcept {
  LiveFiles& live = liveFiles();
  std::lock_guard lock(live.mutex);
  live.closed = true;
  for (const fs::path& path : live.paths) unlink(path.c_str());
  for (const auto& [owner, clean] : live.cleaners) clean();
}

}  // namespace kagefude
