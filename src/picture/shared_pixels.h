#pragma once

#include <cstddef>

#include "picture/message_socket.h"

namespace kagefude {

/// Memory that two processes see: made by one, sent as a descriptor, mapped by both.
class SharedPixels {
 public:
  /// New memory of `bytes` zeros. Throws std::bad_alloc, and std::system_error where a limit on the
  /// size of files (ulimit -f) forbids it, for the kernel counts it as one.
  explicit SharedPixels(size_t bytes);
  /// The memory that came with a message. Throws std::bad_alloc when it is not of `bytes`.
  SharedPixels(Descriptor received, size_t bytes);
  ~SharedPixels();
  SharedPixels(const SharedPixels&) = delete;
  SharedPixels& operator=(const SharedPixels&) = delete;

  std::byte* data() const { return data_; }
  size_t bytes() const { return bytes_; }
  int descriptor() const { return descriptor_.number(); }

 private:
  void map();

  Descriptor descriptor_;
  size_t bytes_;
  std::byte* data_ = nullptr;
};

}  // namespace kagefude
