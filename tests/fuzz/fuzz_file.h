#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace kagefude::fuzz {

/// A file that holds the input, for readers that take paths: in memory where the system has such a
/// folder, one name a process.
class FuzzFile {
 public:
  FuzzFile(std::string_view contents, const std::string& extension) {
    const std::filesystem::path shared = "/dev/shm";
    const bool inMemory = std::filesystem::is_directory(shared);
    path_ = (inMemory ? shared : std::filesystem::temp_directory_path()) /
            ("kagefude_fuzz_" + std::to_string(getpid()) + extension);
    std::ofstream(path_, std::ios::binary)
        .write(contents.data(), static_cast<std::streamsize>(contents.size()));
  }
  ~FuzzFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace kagefude::fuzz
