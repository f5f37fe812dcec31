#include <unistd.h>

#include <iostream>

#include "cli/commands.h"

int main(int argc, char** argv) {
  kagefude::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0};
  return kagefude::runProgram(argc, argv, console);
}
