#include "live/stage.h"

#include <atomic>

namespace kagefude {

uint64_t nextVersion() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

}  // namespace kagefude
