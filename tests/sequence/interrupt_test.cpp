#include "sequence/interrupt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>

#include "base/temp_file.h"
#include "test_folder.h"

namespace kagefude {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// A child process that runs `body` under Interrupts and says "ready" through a pipe.
class Child {
 public:
  explicit Child(const std::function<int(Interrupts&)>& body,
                 milliseconds grace = milliseconds(1500)) {
    int ends[2];
    if (pipe(ends) != 0) std::abort();
    pid_ = fork();
    if (pid_ == 0) {
      std::signal(SIGHUP, SIG_DFL);  // whoever started the tests under nohup has it ignored
      Interrupts interrupts([](int code) { _exit(code); }, grace);
      if (::write(ends[1], "r", 1) != 1) _exit(99);
      _exit(body(interrupts));
    }
    char ready = 0;
    if (::read(ends[0], &ready, 1) != 1) std::abort();
    close(ends[0]);
    close(ends[1]);
  }

  void signal(int number) const { kill(pid_, number); }
  /// The exit code, 1000 + the signal that killed it, or -1 when it did not end in five seconds.
  int wait() const {
    int status = 0;
    for (int i = 0; i < 500; ++i, usleep(10000))
      if (waitpid(pid_, &status, WNOHANG) == pid_)
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    kill(pid_, SIGKILL);
    waitpid(pid_, &status, 0);
    return -1;
  }

 private:
  pid_t pid_ = 0;
};

int workUntilAsked(Interrupts& interrupts) {
  while (!interrupts.requested()) usleep(1000);
  return interrupts.exitCode();
}

int hang(Interrupts&) {
  sleep(30);
  return 0;
}

TEST(Interrupts, EachSignalHasItsExitCode) {
  for (const auto& [number, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const Child child(workUntilAsked);
    child.signal(number);
    EXPECT_EQ(child.wait(), code);
  }
}

TEST(Interrupts, WorkThatDoesNotListenEndsAfterTheGrace) {
  const Child child(hang, milliseconds(100));
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 143);
}

TEST(Interrupts, ASecondSignalEndsAtOnceAndRemovesTemporaries) {
  const TestFolder folder;
  const std::string target = folder / "a.exr";
  const Child child(
      [&](Interrupts& interrupts) {
        const TempFile file(target);
        while (!interrupts.requested()) usleep(1000);
        return hang(interrupts);
      },
      milliseconds(60000));
  while (folder.entries() == 0) usleep(1000);
  child.signal(SIGINT);
  usleep(100000);
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 130) << "the first signal gives the code";
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Interrupts, NoSignalEndsAtOnceWithoutACode) {
  const auto start = steady_clock::now();
  for (int i = 0; i < 50; ++i) {
    const Interrupts interrupts([](int code) { _exit(code); });
    EXPECT_EQ(interrupts.exitCode(), 0);
    EXPECT_FALSE(interrupts.requested());
  }
  EXPECT_LT(steady_clock::now() - start, std::chrono::seconds(2));
}

TEST(Interrupts, AClosedPipeDoesNotKill) {
  const Child child([](Interrupts&) {
    int ends[2];
    if (pipe(ends) != 0) return 1;
    close(ends[0]);
    return ::write(ends[1], "x", 1) == -1 && errno == EPIPE ? 7 : 2;
  });
  EXPECT_EQ(child.wait(), 7);
}

}  // namespace
}  // namespace kagefude
