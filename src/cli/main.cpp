#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

#include "cli/commands.h"

int main(int argc, char** argv) {
  kagefude::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0};
  winsize window{};
  if (console.terminal && ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0)
    console.columns = window.ws_col;
  return kagefude::runProgram(argc, argv, console);
}
