#include "sequence/interrupt.h"

#include <signal.h>
#include <time.h>

#include <cerrno>

#include "base/temp_file.h"

namespace kagefude {
namespace {

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
  pthread_sigmask(SIG_BLOCK, &watched, &before_);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  watcher_ = std::thread([this] { watch(); });
}

Interrupts::~Interrupts() {
  finished_ = true;
  pthread_kill(watcher_.native_handle(), SIGTERM);  // only wakes the watcher
  watcher_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

/// The next signal, or 0 when the time is over or the work has ended.
int Interrupts::waitForSignal(const timespec* most) {
  const sigset_t watched = watchedSignals();
  int signal = 0;
  do {
    signal = most ? sigtimedwait(&watched, nullptr, most) : sigwaitinfo(&watched, nullptr);
  } while (signal < 0 && errno == EINTR);
  return finished_ || signal < 0 ? 0 : signal;
}

void Interrupts::watch() {
  const int first = waitForSignal(nullptr);
  if (first == 0) return;
  exitCode_ = 128 + first;
  source_.request_stop();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(grace_);
  const timespec grace{seconds.count(), std::chrono::nanoseconds(grace_ - seconds).count()};
  waitForSignal(&grace);
  if (finished_) return;
  removeLiveTempFiles();
  leave_(128 + first);
}

}  // namespace kagefude
