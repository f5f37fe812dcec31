#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/error.h"

namespace kagefude {
namespace {

constexpr size_t bufferBytes = size_t{1} << 20;

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path finalPath) : file_(std::move(finalPath)) {
  descriptor_ = ::open(file_.path().c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail(errno);
  buffer_.reserve(bufferBytes);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::fail(int error) {
  error_ = error;
  throw OutputError(fmt::format("cannot write {}: {}", finalPath().string(),
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
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail(errno);
  file_.commit();
}

}  // namespace kagefude
