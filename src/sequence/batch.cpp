#include "sequence/batch.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <limits>
#include <mutex>
#include <new>
#include <optional>

#include "base/error.h"
#include "sequence/memory_bound.h"

namespace kagefude {
namespace {

constexpr size_t kNone = std::numeric_limits<size_t>::max();

struct Failure {
  std::string message;
  bool spoilsAll = false;
};

/// Runs one stage, timed, cut off from other frames' work: a thread that waits inside for its
/// parallel loop may take tasks of that loop only.
template <class Stage>
std::optional<Failure> runStage(double* seconds, const Stage& stage) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<Failure> failure;
  try {
    tbb::this_task_arena::isolate(stage);
  } catch (const OutputError& error) {
    failure = Failure{error.what(), true};
  } catch (const std::bad_alloc&) {
    failure = Failure{"the machine has too little memory left for it", false};
  } catch (const std::exception& error) {
    failure = Failure{error.what(), false};
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  *seconds += taken.count();
  return failure;
}

/// Admits frames in order while memory and threads allow, and lets each finished frame admit the
/// next ones, so no thread of the pool ever waits for memory.
class Loop {
 public:
  Loop(size_t count, const WorkSource& source, const BatchOptions& options)
      : count_(count), source_(source), options_(options) {
    const auto threads = static_cast<size_t>(tbb::this_task_arena::max_concurrency());
    maxFrames_ = options.maxFrames > 0 ? std::min(options.maxFrames, threads) : threads;
  }

  BatchResult run() {
    admit();
    group_.wait();
    result_.untouched = count_ - result_.done - result_.kept - result_.failures.size();
    result_.stopped = options_.stop.stop_requested() && result_.untouched > 0;
    std::sort(result_.failures.begin(), result_.failures.end(),
              [](const auto& a, const auto& b) { return a.index < b.index; });
    return std::move(result_);
  }

 private:
  struct Admitted {
    size_t index = 0;
    size_t memory = 0;
  };

  /// Whether a frame is to be left: work was interrupted, or a frame before it has failed.
  bool givenUp(size_t index) const {
    if (options_.stop.stop_requested()) return true;
    std::lock_guard lock(mutex_);
    return index > firstFatal_;
  }

  size_t estimate(size_t index) const {
    if (!source_.memory) return 0;
    try {
      return source_.memory(index);
    } catch (const std::exception&) {
      return 0;  // the read stage meets the same trouble and says it
    }
  }

  /// Admits what fits. Estimates read headers, so they are made outside the lock, one at a time;
  /// whoever makes one comes back for what has become free meanwhile.
  void admit() {
    for (;;) {
      size_t begun = 0;
      std::optional<size_t> unknown;
      {
        std::lock_guard lock(mutex_);
        begun = admitKnown();
        if (mayBegin() && !nextMemory_ && !estimating_) unknown = next_;
        if (unknown) estimating_ = true;
      }
      // Tasks take the oldest admitted frame, whichever task runs first.
      for (; begun > 0; --begun) group_.run([this] { runNext(); });
      if (!unknown) return;
      const size_t memory = estimate(*unknown);
      std::lock_guard lock(mutex_);
      nextMemory_ = memory;
      estimating_ = false;
    }
  }

  bool mayBegin() const {
    return next_ < count_ && inFlight_ < maxFrames_ && next_ <= firstFatal_ &&
           !options_.stop.stop_requested();
  }

  size_t admitKnown() {
    size_t begun = 0;
    for (; mayBegin() && nextMemory_; ++begun) {
      // A frame that is too large by itself is let through to fail with that reason.
      const size_t memory = tooLarge(*nextMemory_) ? 0 : *nextMemory_;
      if (options_.maxMemory > 0 && memory_ + memory > options_.maxMemory) break;
      waiting_.push_back({next_++, *nextMemory_});
      nextMemory_.reset();
      memory_ += memory;
      ++inFlight_;
      result_.mostInFlight = std::max(result_.mostInFlight, inFlight_);
      result_.mostMemory = std::max(result_.mostMemory, memory_);
    }
    return begun;
  }

  bool tooLarge(size_t memory) const {
    return options_.maxMemory > 0 && memory > options_.maxMemory;
  }

  void runNext() {
    Admitted admitted;
    {
      std::lock_guard lock(mutex_);
      admitted = waiting_.front();
      waiting_.pop_front();
    }
    runFrame(admitted);
    {
      std::lock_guard lock(mutex_);
      --inFlight_;
      if (!tooLarge(admitted.memory)) memory_ -= admitted.memory;
    }
    admit();
  }

  void runFrame(const Admitted& admitted) {
    FrameEvent event;
    event.index = admitted.index;
    std::optional<Failure> failure;
    bool kept = false;
    if (givenUp(event.index)) return;
    if (tooLarge(admitted.memory)) {
      failure =
          Failure{fmt::format("it needs about {}, more than --max-memory {}",
                              formatMemory(admitted.memory), formatMemory(options_.maxMemory)),
                  false};
    } else {
      const std::unique_ptr<FrameWork> work = source_.make(event.index);
      failure = runStage(&event.readSeconds, [&] { kept = work->isDone(); });
      if (!failure && !kept) {
        if (givenUp(event.index)) return;
        failure = runStage(&event.readSeconds, [&] { work->read(); });
        if (!failure) {
          if (givenUp(event.index)) return;
          failure = runStage(&event.computeSeconds, [&] { work->compute(); });
        }
        if (!failure) {
          if (givenUp(event.index)) return;
          failure = runStage(&event.writeSeconds, [&] { work->write(); });
        }
      }
    }
    finish(std::move(event), failure, kept);
  }

  void finish(FrameEvent event, const std::optional<Failure>& failure, bool kept) {
    {
      std::lock_guard lock(mutex_);
      if (failure) {
        event.outcome = FrameOutcome::failed;
        event.message = failure->message;
        result_.failures.push_back({event.index, failure->message});
        if (failure->spoilsAll || !options_.skipBadFrames)
          firstFatal_ = std::min(firstFatal_, event.index);
      } else {
        event.outcome = kept ? FrameOutcome::kept : FrameOutcome::done;
        ++(kept ? result_.kept : result_.done);
      }
    }
    std::lock_guard lock(eventMutex_);
    if (options_.onFrame) options_.onFrame(event);
  }

  const size_t count_;
  const WorkSource& source_;
  const BatchOptions& options_;
  size_t maxFrames_ = 1;
  tbb::task_group group_;

  mutable std::mutex mutex_;
  std::deque<Admitted> waiting_;
  size_t next_ = 0;
  std::optional<size_t> nextMemory_;  ///< of frame next_, once it is known
  bool estimating_ = false;
  size_t inFlight_ = 0;
  size_t memory_ = 0;
  size_t firstFatal_ = kNone;
  BatchResult result_;

  std::mutex eventMutex_;
};

}  // namespace

BatchResult runWork(size_t count, const WorkSource& source, const BatchOptions& options) {
  return Loop(count, source, options).run();
}

}  // namespace kagefude
