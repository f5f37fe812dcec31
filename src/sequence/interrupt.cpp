#include "sequence/interrupt.h"

#include <signal.h>
#include <time.h>

#include "base/temp_file.h"

namespace kagefude {
namespace {

constexpr auto kLookAround = std::chrono::milliseconds(50);

sigset_t watchedSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  struct sigaction hangUp {};
  if (sigaction(SIGHUP, nullptr, &hangUp) == 0 && hangUp.sa_handler != SIG_IGN)
    sigaddset(&set, SIGHUP);
  return set;
}

}  // namespace

Interrupts::Interrupts(std::function<void(int)> leave, std::chrono::milliseconds grace)
    : leave_(std::move(leave)), grace_(grace) {
  const sigset_t watched = watchedSignals();
  pthread_sigmask(SIG_BLOCK, &watched, nullptr);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  watcher_ = std::thread([this] { watch(); });
}

Interrupts::~Interrupts() {
  finished_ = true;
  watcher_.join();
}

/// The next signal, or 0 when the time is over or the work has ended. The wait is cut into short
/// ones so that a run that ends by itself is not held up.
int Interrupts::waitForSignal(std::chrono::milliseconds most) {
  const auto end = std::chrono::steady_clock::now() + most;
  const sigset_t watched = watchedSignals();
  const timespec shortWait{0, std::chrono::nanoseconds(kLookAround).count()};
  while (!finished_ && std::chrono::steady_clock::now() < end) {
    const int signal = sigtimedwait(&watched, nullptr, &shortWait);
    if (signal > 0) return signal;
  }
  return 0;
}

void Interrupts::watch() {
  int first = 0;
  while (first == 0 && !finished_) first = waitForSignal(std::chrono::hours(1));
  if (first == 0) return;
  exitCode_ = 128 + first;
  source_.request_stop();
  waitForSignal(grace_);
  if (finished_) return;
  removeLiveTempFiles();
  leave_(128 + first);
}

}  // namespace kagefude
