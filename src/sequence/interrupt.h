#pragma once

#include <signal.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <stop_token>
#include <thread>

namespace kagefude {

/// Turns SIGINT, SIGTERM and SIGHUP (unless nohup ignores it) into a stop token, and guarantees an
/// end soon after. Make one at the start of main, before any other thread exists: it blocks the
/// signals in the calling thread, which later threads inherit, and waits for them in a thread of
/// its own, so nothing has to be safe inside a signal handler. SIGPIPE and SIGXFSZ are ignored from
/// then on: a closed log or a size limit becomes an error of the write that meets it.
///
/// At the first signal the stop token is set and work ends at the next stage. At the second one, or
/// when `grace` has passed, live temporary files are removed and `leave(exitCode)` is called from
/// the watching thread; it must not return (std::_Exit).
class Interrupts {
 public:
  explicit Interrupts(std::function<void(int exitCode)> leave,
                      std::chrono::milliseconds grace = std::chrono::milliseconds(1500));
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  std::stop_token token() const { return source_.get_token(); }
  bool requested() const { return source_.stop_requested(); }
  /// 128 + the first signal (130 for SIGINT, 143 for SIGTERM), 0 when there was none.
  int exitCode() const { return exitCode_.load(); }

 private:
  void watch();
  int waitForSignal(const timespec* most);

  std::function<void(int)> leave_;
  std::chrono::milliseconds grace_;
  sigset_t before_{};
  std::stop_source source_;
  std::atomic<int> exitCode_{0};
  std::atomic<bool> finished_{false};
  std::thread watcher_;
};

/// For commands that write one file, or few: nothing is finished at a signal, what is half written
/// goes and the process ends.
class EndsAtOnce {
 public:
  EndsAtOnce() : interrupts_([](int code) { std::_Exit(code); }, std::chrono::milliseconds(0)) {}

 private:
  Interrupts interrupts_;
};

}  // namespace kagefude
