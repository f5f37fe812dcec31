#include "base/standard_descriptors.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kagefude {
namespace {

/// Closes descriptors in a process of its own and returns the number that the next file gets there.
int nextAfterClosing(std::initializer_list<int> closed) {
  const pid_t child = fork();
  if (child == 0) {
    for (const int descriptor : closed) close(descriptor);
    ensureStandardDescriptors();
    _exit(open("/dev/null", O_WRONLY));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StandardDescriptors, NoFileOfOursGetsTheNumberOfOne) {
  EXPECT_GT(nextAfterClosing({}), 2);
  EXPECT_GT(nextAfterClosing({0, 1, 2}), 2);
  EXPECT_GT(nextAfterClosing({1}), 2);
  EXPECT_GT(nextAfterClosing({0, 2}), 2);
}

}  // namespace
}  // namespace kagefude
