#include <malloc.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

#include "base/standard_descriptors.h"
#include "cli/commands.h"

int main(int argc, char** argv) {
  kagefude::ensureStandardDescriptors();
  // With an arena a thread, the allocator keeps planes of finished frames in every one of them, and
  // a batch was measured at twice its --max-memory. Planes are few and large, so one is enough.
  mallopt(M_ARENA_MAX, 1);
  // Fixed, for it would grow with what is freed, and large blocks would then stay in the heap.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  kagefude::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0};
  winsize window{};
  if (console.terminal && ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0)
    console.columns = window.ws_col;
  return kagefude::runProgram(argc, argv, console);
}
