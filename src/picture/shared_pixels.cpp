#include "picture/shared_pixels.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <string>
#include <system_error>

namespace kagefude {

SharedPixels::SharedPixels(size_t bytes)
    : descriptor_(memfd_create("kagefude", MFD_CLOEXEC)), bytes_(bytes) {
  if (!descriptor_) throw std::bad_alloc();
  if (ftruncate(descriptor_.number(), static_cast<off_t>(bytes)) != 0) {
    if (errno != EFBIG) throw std::bad_alloc();
    throw std::system_error(errno, std::generic_category(),
                            std::to_string(bytes) +
                                " bytes of pixels are more than the limit on the size of files "
                                "(ulimit -f) allows");
  }
  map();
}

SharedPixels::SharedPixels(Descriptor received, size_t bytes)
    : descriptor_(std::move(received)), bytes_(bytes) {
  // A write beyond a mapped file's end is a fatal signal.
  struct stat status {};
  if (!descriptor_ || fstat(descriptor_.number(), &status) != 0 ||
      status.st_size != static_cast<off_t>(bytes))
    throw std::bad_alloc();
  map();
}

SharedPixels::~SharedPixels() {
  if (data_) munmap(data_, bytes_);
}

void SharedPixels::map() {
  if (bytes_ == 0) return;
  void* const memory =
      mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_.number(), 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::byte*>(memory);
}

}  // namespace kagefude
