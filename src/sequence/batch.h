#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace kagefude {

enum class FrameOutcome { done, kept, failed };

/// What became of one frame. `index` is the caller's, 0 … count − 1.
struct FrameEvent {
  size_t index = 0;
  FrameOutcome outcome = FrameOutcome::done;
  double readSeconds = 0;
  double computeSeconds = 0;
  double writeSeconds = 0;
  std::string message;  ///< why it failed
};

/// The work on a frame, in three stages that pass its planes on, with the types that suit the
/// caller. Stages of different frames run at the same time, so they share nothing that changes.
template <class Input, class Output>
struct Stages {
  std::function<Input(size_t index)> read;
  std::function<Output(size_t index, Input)> compute;
  std::function<void(size_t index, Output)> write;
  /// The most bytes that the frame needs while it is in flight; 0 when unknown. Called once a
  /// frame, before its other stages, for one frame at a time. May read headers; what it throws is
  /// left to `read` to say. Absent: no bound by memory.
  std::function<size_t(size_t index)> memory;
  /// True when the outputs are there and right, so that the frame is kept. Absent: none is.
  std::function<bool(size_t index)> isDone;
};

struct BatchOptions {
  size_t maxMemory = 0;  ///< bytes for all frames in flight together; 0 is no bound
  size_t maxFrames = 0;  ///< frames in flight; 0 is one per thread of the current arena
  bool skipBadFrames = false;
  std::stop_token stop;  ///< looked at before every stage
  /// Called once per finished frame, never twice at a time, in order of finishing.
  std::function<void(const FrameEvent&)> onFrame;
};

struct FrameFailure {
  size_t index = 0;
  std::string message;
};

struct BatchResult {
  size_t done = 0;
  size_t kept = 0;
  std::vector<FrameFailure> failures;  ///< by index
  std::vector<size_t> lost;  ///< by index; made or kept, and gone since: neither done nor kept
  size_t untouched = 0;      ///< not begun, or given up between two stages
  bool stopped = false;      ///< the stop token was set before all frames were finished
  size_t mostInFlight = 0;   ///< frames at a time, at most
  size_t mostMemory = 0;     ///< sum of their estimates, at most
};

/// A frame's work with its types hidden: one object per frame in flight, whose stages are called
/// in order, from one thread at a time.
class FrameWork {
 public:
  virtual ~FrameWork() = default;
  virtual bool isDone() = 0;
  virtual void read() = 0;
  virtual void compute() = 0;
  virtual void write() = 0;
};

struct WorkSource {
  std::function<std::unique_ptr<FrameWork>(size_t index)> make;
  std::function<size_t(size_t index)> memory;
};

/// The loop behind runBatch.
BatchResult runWork(size_t count, const WorkSource& source, const BatchOptions& options);

namespace detail {

template <class Input, class Output>
class StagedFrame : public FrameWork {
 public:
  StagedFrame(const Stages<Input, Output>& stages, size_t index) : stages_(stages), index_(index) {}

  bool isDone() override { return stages_.isDone && stages_.isDone(index_); }
  void read() override { input_ = std::make_unique<Input>(stages_.read(index_)); }
  void compute() override {
    const auto input = std::move(input_);
    output_ = std::make_unique<Output>(stages_.compute(index_, std::move(*input)));
  }
  void write() override {
    const auto output = std::move(output_);
    stages_.write(index_, std::move(*output));
  }

 private:
  const Stages<Input, Output>& stages_;
  size_t index_;
  std::unique_ptr<Input> input_;
  std::unique_ptr<Output> output_;
};

}  // namespace detail

/// Makes frames 0 … count − 1, several at a time: while one is computed its neighbours are read and
/// written. Each frame runs through its stages on one thread of the current TBB arena (whose size
/// is --threads), and a stage's own parallel loops are helped by the threads that have no frame; a
/// thread that waits in such a loop never picks up another frame's stage, so at most one frame per
/// thread is open and no stage can starve or deadlock another.
///
/// Frames begin in order, and only while the sum of their estimates stays within maxMemory. A frame
/// that alone is larger fails with that reason. What a stage computes must depend on its frame
/// alone; then the outputs do not depend on threads, memory or order.
///
/// A stage that throws fails its frame. With skipBadFrames the others go on, except after an
/// OutputError (a full disk spoils every frame). Otherwise frames behind the failed one are given
/// up at their next stage, frames before it are finished, so the first failure is the one that
/// frame-by-frame work would have met, and everything before it is there. A set stop token gives up
/// every frame at its next stage. Cost beyond the stages: microseconds per frame.
template <class Input, class Output>
BatchResult runBatch(size_t count, const Stages<Input, Output>& stages,
                     const BatchOptions& options) {
  WorkSource source;
  source.make = [&](size_t index) {
    return std::make_unique<detail::StagedFrame<Input, Output>>(stages, index);
  };
  source.memory = stages.memory;
  return runWork(count, source, options);
}

}  // namespace kagefude
