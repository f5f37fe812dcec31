#include "base/standard_descriptors.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <initializer_list>

namespace kagefude {

void ensureStandardDescriptors() {
  constexpr int exitOfWrongUse = 2;
  for (const int wanted : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(wanted, F_GETFD) >= 0) continue;
    // The lowest free number is taken, and those below are open by now.
    if (open("/dev/null", O_RDWR) != wanted) std::_Exit(exitOfWrongUse);
  }
}

}  // namespace kagefude
