#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace kagefude {

/// A file that appears under its final name whole or not at all. Bytes go to a temporary in the
/// same folder, `.<name>.kagefude-XXXXXX`; commit() flushes it to the disk and renames it. Without
/// commit, or on any error, the destructor removes the temporary. All errors are OutputError with
/// the final name and the reason (no such folder, no right to write, disk full).
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path finalPath);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, size_t count);
  void seek(uint64_t position);
  uint64_t position() const { return position_; }
  void commit();

  const std::filesystem::path& finalPath() const { return finalPath_; }
  const std::filesystem::path& temporaryPath() const { return temporaryPath_; }

 private:
  void flush();
  [[noreturn]] void fail(int error);

  std::filesystem::path finalPath_;
  std::filesystem::path temporaryPath_;
  std::vector<char> buffer_;
  uint64_t position_ = 0;
  int descriptor_ = -1;
  int error_ = 0;
};

/// Whether a file name has the form of AtomicFile's temporaries (left behind by a kill).
bool isTemporaryName(const std::string& fileName);

}  // namespace kagefude
