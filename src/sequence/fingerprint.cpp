#include "sequence/fingerprint.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "base/files_read.h"
#include "base/plain_file.h"

namespace kagefude {
namespace {

constexpr int64_t kReadWhole = int64_t{1} << 20;
constexpr int64_t kSample = 4096;
constexpr int64_t kSamples = 64;

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : path_(path), file_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (file_ < 0 && errno != ENOENT) fail();
  }
  ~OpenFile() {
    if (file_ >= 0) close(file_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool exists() const { return file_ >= 0; }

  struct stat status() const {
    struct stat result {};
    if (fstat(file_, &result) != 0) fail();
    return result;
  }

  std::string bytes(int64_t from, int64_t count) const {
    std::string buffer(static_cast<size_t>(count), '\0');
    size_t have = 0;
    while (have < buffer.size()) {
      const ssize_t got =
          pread(file_, buffer.data() + have, buffer.size() - have, from + static_cast<off_t>(have));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail();
      if (got == 0) break;
      have += static_cast<size_t>(got);
    }
    buffer.resize(have);
    return buffer;
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(fmt::format("cannot read {}: {}", path_.string(), std::strerror(errno)));
  }

  const std::filesystem::path& path_;
  int file_;
};

/// Seconds and nanoseconds apart: together they overflow in the year 2262.
std::string changeOf(const struct stat& status) {
  return fmt::format("{}.{:09}", status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

}  // namespace

Fingerprint::Fingerprint() : digest_(32, '0') {}

Fingerprint& Fingerprint::add(std::string_view label, std::string_view bytes) {
  const std::string lengths = fmt::format("|{}|{}|", label.size(), bytes.size());
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  for (const std::string_view piece :
       {std::string_view(digest_), std::string_view(lengths), label, bytes})
    XXH3_128bits_update(&state, piece.data(), piece.size());
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(&state));
  digest_ = fmt::format("{:02x}", fmt::join(canonical.digest, ""));
  return *this;
}

Fingerprint& Fingerprint::add(std::string_view label, int64_t number) {
  return add(label, fmt::format("{}", number));
}

Fingerprint& Fingerprint::addFile(std::string_view label, const std::filesystem::path& file) {
  add(label, file.filename().string());
  const OpenFile opened(file);
  if (!opened.exists()) return add("missing", "");
  const struct stat status = opened.status();
  if (!S_ISREG(status.st_mode)) requirePlainFile(file);
  const int64_t size = status.st_size;
  noteFileRead(file);
  add("size", size);
  if (size <= kReadWhole) return add("content", opened.bytes(0, size));
  add("changed", changeOf(status));
  std::string samples;
  for (int64_t i = 0; i < kSamples; ++i)
    samples += opened.bytes((size - kSample) / (kSamples - 1) * i, kSample);
  return add("samples", samples + opened.bytes(size - kSample, kSample));
}

std::string Fingerprint::hex() const { return digest_; }

std::string FileDigests::of(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return Fingerprint().addFile("file", file).hex();
  const std::string state =
      fmt::format("{} {} {} {} {}.{:09}", status.st_dev, status.st_ino, status.st_size,
                  changeOf(status), status.st_ctim.tv_sec, status.st_ctim.tv_nsec);
  {
    std::lock_guard lock(mutex_);
    const auto known = known_.find(file);
    if (known != known_.end() && known->second.state == state) return known->second.digest;
  }
  const std::string digest = Fingerprint().addFile("file", file).hex();
  std::lock_guard lock(mutex_);
  known_[file] = {state, digest};
  return digest;
}

}  // namespace kagefude
