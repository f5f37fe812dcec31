#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/temp_file.h"

namespace kagefude {

/// Bytes for a TempFile, buffered and with seeks: the file appears under its final name whole or
/// not at all. Without commit(), or on any error, nothing is left. All errors are OutputError with
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

  const std::filesystem::path& finalPath() const { return file_.target(); }
  const std::filesystem::path& temporaryPath() const { return file_.path(); }

 private:
  void flush();
  [[noreturn]] void fail(int error);

  TempFile file_;
  std::vector<char> buffer_;
  uint64_t position_ = 0;
  int descriptor_ = -1;
  int error_ = 0;
};

}  // namespace kagefude
