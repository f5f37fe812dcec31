#include "base/plain_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/files_read.h"

namespace kagefude {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("{} cannot be read: {}", path.string(), why));
}

void requireRegular(const std::filesystem::path& path, mode_t mode) {
  if (S_ISREG(mode)) return;
  const char* const what = S_ISDIR(mode)    ? "a folder"
                           : S_ISFIFO(mode) ? "a pipe"
                           : S_ISSOCK(mode) ? "a socket"
                                            : "a device";
  refuse(path, fmt::format("it is {}, and a plain file is expected", what));
}

struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

}  // namespace

uint64_t requirePlainFile(const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) refuse(path, std::strerror(errno));
  requireRegular(path, status.st_mode);
  noteFileRead(path);
  return static_cast<uint64_t>(status.st_size);
}

std::string readPlainFile(const std::filesystem::path& path, uint64_t most) {
  // Not blocking: a pipe without a writer would be waited for before it can be looked at.
  const Descriptor file{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  struct stat status {};
  if (file.number < 0 || fstat(file.number, &status) != 0) refuse(path, std::strerror(errno));
  requireRegular(path, status.st_mode);
  noteFileRead(path);
  const auto size = static_cast<uint64_t>(status.st_size);
  if (size > most) refuse(path, fmt::format("it has {} bytes; at most {} are allowed", size, most));
  std::string text(size, '\0');
  size_t have = 0;
  while (have < text.size()) {
    const ssize_t got = read(file.number, text.data() + have, text.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(path, std::strerror(errno));
    if (got == 0) break;
    have += static_cast<size_t>(got);
  }
  text.resize(have);
  return text;
}

}  // namespace kagefude
