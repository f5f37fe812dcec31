#include "frame/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>

#include "base/error.h"

namespace kagefude {
namespace {

constexpr std::string_view mark = ".kagefude-";
constexpr size_t bufferBytes = size_t{1} << 20;
constexpr size_t longestName = 255, randomLetters = 6;

std::filesystem::path folderOf(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

std::string randomName() {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device device;
  std::string name(randomLetters, ' ');
  for (char& c : name) c = letters[device() % letters.size()];
  return name;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path finalPath) : finalPath_(std::move(finalPath)) {
  const size_t extra = 1 + mark.size() + randomLetters;
  std::string name = finalPath_.filename().string();
  if (name.empty()) throw OutputError("an output file has no name: " + finalPath_.string());
  if (name.size() + extra > longestName && name.size() <= longestName) {
    name.resize(longestName - extra);
  }
  // A name that another process has taken is an error with EEXIST; then try the next one.
  for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
    const auto candidate = folderOf(finalPath_) / fmt::format(".{}{}{}", name, mark, randomName());
    descriptor_ = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) temporaryPath_ = candidate;
    if (descriptor_ < 0 && errno != EEXIST) fail(errno);
  }
  if (descriptor_ < 0) fail(EEXIST);
  buffer_.reserve(bufferBytes);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporaryPath_.empty()) ::unlink(temporaryPath_.c_str());
}

void AtomicFile::fail(int error) {
  error_ = error;
  throw OutputError(fmt::format("{} cannot be written: {}", finalPath_.string(),
                                std::generic_category().message(error)));
}

void AtomicFile::write(const void* bytes, size_t count) {
  if (error_ != 0) fail(error_);
  const char* const first = static_cast<const char*>(bytes);
  if (buffer_.size() + count > bufferBytes) flush();
  if (count > bufferBytes) {
    buffer_.assign(first, first + count);
    flush();
  } else {
    buffer_.insert(buffer_.end(), first, first + count);
  }
  position_ += count;
}

void AtomicFile::flush() {
  size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : ENOSPC);
    done += static_cast<size_t>(written);
  }
  buffer_.clear();
}

void AtomicFile::seek(uint64_t position) {
  if (error_ != 0) fail(error_);
  flush();
  if (::lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0) fail(errno);
  position_ = position;
}

void AtomicFile::commit() {
  if (error_ != 0) fail(error_);
  flush();
  if (::fsync(descriptor_) != 0) fail(errno);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail(errno);
  if (::rename(temporaryPath_.c_str(), finalPath_.c_str()) != 0) fail(errno);
  temporaryPath_.clear();
  // The new name is on the disk only when its folder is; some file systems cannot do that, and the
  // file itself is safe already, so a refusal is no error.
  const int folder = ::open(folderOf(finalPath_).c_str(), O_RDONLY | O_DIRECTORY);
  if (folder >= 0) {
    ::fsync(folder);
    ::close(folder);
  }
}

bool isTemporaryName(const std::string& fileName) {
  const size_t tail = mark.size() + randomLetters;
  return fileName.size() > tail + 1 && fileName.front() == '.' &&
         fileName.compare(fileName.size() - tail, mark.size(), mark) == 0;
}

}  // namespace kagefude
