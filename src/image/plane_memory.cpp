#include "image/plane_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

namespace kagefude {
namespace {

// Not under the address sanitizer (of GCC, of clang), so that a use after freeing is found.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool keeps = false;
#elif defined(__has_feature)
constexpr bool keeps = !__has_feature(address_sanitizer);
#else
constexpr bool keeps = true;
#endif
constexpr size_t hugePage = size_t{2} << 20;
// Those that the C library would map anew each time. Clearing their pages took 18 % of the strokes
// and edges of a 1024 x 576 frame.
constexpr size_t leastKept = size_t{128} << 10;

bool isLarge(size_t bytes) { return bytes >= 2 * hugePage; }
bool isKept(size_t bytes) { return bytes >= leastKept; }

size_t roundedUp(size_t bytes, size_t unit) { return (bytes + unit - 1) / unit * unit; }

void* allocate(size_t alignment, size_t bytes) {
  void* const memory = std::aligned_alloc(alignment, bytes);
  if (!memory) throw std::bad_alloc();
  if (alignment == hugePage) ::madvise(memory, bytes, MADV_HUGEPAGE);
  return memory;
}

/// The memory that a kept plane takes.
size_t wholeOf(size_t bytes) { return roundedUp(bytes, isLarge(bytes) ? hugePage : 64); }

/// Blocks that wait for the next plane of their size.
class KeptBlocks {
 public:
  void* take(size_t bytes) {
    std::lock_guard lock(mutex_);
    const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(),
                                    [&](const Block& block) { return block.bytes == bytes; });
    used_ += bytes;
    if (found != blocks_.rend()) {
      void* const memory = found->memory;
      blocks_.erase(std::next(found).base());
      kept_ -= bytes;
      return memory;
    }
    most_ = std::max(most_, used_);
    keepWithin(most_ - used_);
    return nullptr;
  }

  /// What was taken could not be had after all.
  void failed(size_t bytes) {
    std::lock_guard lock(mutex_);
    used_ -= bytes;
  }

  void give(void* memory, size_t bytes) {
    std::lock_guard lock(mutex_);
    used_ -= bytes;
    try {
      blocks_.push_back({memory, bytes});
      kept_ += bytes;
    } catch (const std::bad_alloc&) {
      std::free(memory);
    }
    keepWithin(keeps ? most_ - used_ : 0);
  }

  void release() {
    std::lock_guard lock(mutex_);
    keepWithin(0);
    most_ = used_;
  }

 private:
  struct Block {
    void* memory;
    size_t bytes;
  };

  /// Frees the longest kept blocks until no more than `bytes` are left.
  void keepWithin(size_t bytes) {
    auto block = blocks_.begin();
    for (; kept_ > bytes; ++block) {
      kept_ -= block->bytes;
      std::free(block->memory);
    }
    blocks_.erase(blocks_.begin(), block);
  }

  std::mutex mutex_;
  std::vector<Block> blocks_;  ///< the longest kept first
  size_t used_ = 0, kept_ = 0, most_ = 0;
};

/// Never destroyed: planes may outlive every other object.
KeptBlocks& keptBlocks() {
  static KeptBlocks* const blocks = new KeptBlocks;
  return *blocks;
}

}  // namespace

void* takePlaneMemory(size_t bytes) {
  const size_t whole = wholeOf(bytes);
  if (!isKept(bytes)) return allocate(64, whole);
  void* const kept = keptBlocks().take(whole);
  if (kept) return kept;
  try {
    return allocate(isLarge(bytes) ? hugePage : 64, whole);
  } catch (const std::bad_alloc&) {
    keptBlocks().failed(whole);
    throw;
  }
}

void givePlaneMemory(void* memory, size_t bytes) noexcept {
  if (!isKept(bytes) || !memory) {
    std::free(memory);
    return;
  }
  keptBlocks().give(memory, wholeOf(bytes));
}

void releaseKeptPlaneMemory() { keptBlocks().release(); }

}  // namespace kagefude
