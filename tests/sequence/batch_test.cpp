#include "sequence/batch.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "base/error.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

using std::chrono::milliseconds;

/// Stages that pass a number along and keep a diary.
struct Diary {
  std::mutex mutex;
  std::map<size_t, int> written;
  std::vector<FrameEvent> events;
  std::atomic<int> open{0};
  std::atomic<int> mostOpen{0};
  std::atomic<size_t> openMemory{0};
  std::atomic<size_t> mostOpenMemory{0};
};

class Batch : public testing::Test {
 protected:
  Batch() {
    stages.read = [this](size_t index) {
      enter(index);
      return static_cast<int>(index);
    };
    stages.compute = [](size_t, int value) { return value * value + 1; };
    stages.write = [this](size_t index, int value) {
      {
        std::lock_guard lock(diary.mutex);
        diary.written[index] = value;
      }
      leave(index);
    };
    options.onFrame = [this](const FrameEvent& event) { diary.events.push_back(event); };
  }

  void enter(size_t index) {
    int open = ++diary.open;
    for (int most = diary.mostOpen; open > most;)
      if (diary.mostOpen.compare_exchange_weak(most, open)) break;
    const size_t bytes = stages.memory ? stages.memory(index) : 0;
    const size_t memory = diary.openMemory += bytes;
    for (size_t most = diary.mostOpenMemory; memory > most;)
      if (diary.mostOpenMemory.compare_exchange_weak(most, memory)) break;
  }
  void leave(size_t index) {
    --diary.open;
    diary.openMemory -= stages.memory ? stages.memory(index) : 0;
  }

  BatchResult run(size_t count, int threads = 2) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return runBatch(count, stages, options); });
  }
  std::set<size_t> writtenFrames() const {
    std::set<size_t> frames;
    for (const auto& [index, value] : diary.written) frames.insert(index);
    return frames;
  }

  Diary diary;
  Stages<int, int> stages;
  BatchOptions options;
};

TEST_F(Batch, MakesEveryFrameOnceWhateverTheThreads) {
  for (const int threads : {1, 2, 4}) {
    diary.written.clear();
    diary.events.clear();
    const BatchResult result = run(100, threads);
    EXPECT_EQ(result.done, 100u);
    EXPECT_EQ(result.untouched, 0u);
    ASSERT_EQ(diary.written.size(), 100u);
    for (const auto& [index, value] : diary.written)
      EXPECT_EQ(value, static_cast<int>(index * index + 1));
    EXPECT_EQ(diary.events.size(), 100u);
    EXPECT_LE(result.mostInFlight, static_cast<size_t>(threads));
  }
}

TEST_F(Batch, NoFramesIsNoWork) {
  const BatchResult result = run(0);
  EXPECT_EQ(result.done + result.kept + result.untouched, 0u);
  EXPECT_FALSE(result.stopped);
}

TEST_F(Batch, OneThreadWorksInOrder) {
  std::vector<size_t> order;
  stages.read = [&](size_t index) {
    order.push_back(index);
    return 0;
  };
  run(20, 1);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST_F(Batch, NeighbouringFramesOverlap) {
  // Frame 0 waits in its write stage for frame 1 to be read: only overlapped work ends.
  std::atomic<bool> secondRead{false};
  std::atomic<bool> met{false};
  stages.read = [&](size_t index) {
    if (index == 1) secondRead = true;
    return 0;
  };
  stages.write = [&](size_t index, int) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (index == 0 && !secondRead && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(milliseconds(1));
    if (index == 0) met = secondRead.load();
  };
  run(2, 2);
  EXPECT_TRUE(met);
}

TEST_F(Batch, StaysWithinMemory) {
  stages.memory = [](size_t index) { return 100 + 50 * (index % 7); };
  stages.compute = [](size_t, int value) {
    std::this_thread::sleep_for(milliseconds(1));
    return value;
  };
  options.maxMemory = 700;
  const BatchResult result = run(60, 8);
  EXPECT_EQ(result.done, 60u);
  EXPECT_LE(diary.mostOpenMemory, 700u);
  EXPECT_LE(result.mostMemory, 700u);
  EXPECT_GT(result.mostInFlight, 1u);
}

TEST_F(Batch, MemoryForOneFrameOnlyIsOneAtATime) {
  stages.memory = [](size_t) { return size_t{600}; };
  options.maxMemory = 1000;
  const BatchResult result = run(20, 4);
  EXPECT_EQ(result.done, 20u);
  EXPECT_EQ(diary.mostOpen, 1);
}

TEST_F(Batch, AFrameLargerThanTheBoundFailsWithThatReason) {
  stages.memory = [](size_t index) { return index == 3 ? size_t{5} << 30 : size_t{10}; };
  options.maxMemory = size_t{1} << 30;
  options.skipBadFrames = true;
  const BatchResult result = run(6);
  EXPECT_EQ(result.done, 5u);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].index, 3u);
  EXPECT_NE(result.failures[0].message.find("about 5.0 GiB, more than --max-memory 1.0 GiB"),
            std::string::npos)
      << result.failures[0].message;
}

TEST_F(Batch, AFrameIsEstimatedOnceAndWhileThoseBeforeItRun) {
  std::atomic<bool> read0{false}, met{false};
  std::map<size_t, int> estimates;
  stages.memory = [&](size_t index) {
    ++estimates[index];
    for (int i = 0; index == 1 && i < 20000 && !read0; ++i)
      std::this_thread::sleep_for(milliseconds(1));
    if (index == 1) met = read0.load();
    return size_t{1};
  };
  stages.read = [&](size_t index) {
    if (index == 0) read0 = true;
    return static_cast<int>(index);
  };
  stages.write = [](size_t, int) {};
  const BatchResult result = run(8, 2);
  EXPECT_EQ(result.done, 8u);
  EXPECT_TRUE(met) << "the lock was held while a frame was estimated";
  for (const auto& [index, times] : estimates) EXPECT_EQ(times, 1) << index;
}

TEST_F(Batch, AnEstimateThatThrowsLeavesTheWordToTheReader) {
  stages.memory = [](size_t index) -> size_t {
    if (index == 1) throw InputError("no header");
    return 1;
  };
  stages.read = [](size_t index) -> int {
    if (index == 1) throw InputError("no such file");
    return 0;
  };
  stages.write = [](size_t, int) {};
  options.maxMemory = 10;
  const BatchResult result = run(3);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].message, "no such file");
}

TEST_F(Batch, SkippingBadFramesMakesAllOthers) {
  options.skipBadFrames = true;
  stages.compute = [](size_t index, int value) -> int {
    if (index % 5 == 2) throw InputError("bad frame");
    return value;
  };
  const BatchResult result = run(20);
  EXPECT_EQ(result.done, 16u);
  ASSERT_EQ(result.failures.size(), 4u);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(result.failures[i].index, 5 * i + 2);
  EXPECT_EQ(diary.events.size(), 20u);
  EXPECT_EQ(result.untouched, 0u);
}

TEST_F(Batch, EveryStageMayFail) {
  options.skipBadFrames = true;
  stages.isDone = [](size_t index) -> bool {
    if (index == 0) throw InputError("in isDone");
    return false;
  };
  stages.read = [](size_t index) -> int {
    if (index == 1) throw std::bad_alloc();
    return 0;
  };
  stages.write = [](size_t index, int) {
    if (index == 2) throw std::runtime_error("in write");
  };
  const BatchResult result = run(4);
  ASSERT_EQ(result.failures.size(), 3u);
  EXPECT_EQ(result.failures[0].message, "in isDone");
  EXPECT_NE(result.failures[1].message.find("too little memory"), std::string::npos);
  EXPECT_EQ(result.failures[2].message, "in write");
}

TEST_F(Batch, StoppingAtAFailureFinishesEverythingBeforeIt) {
  for (int round = 0; round < 20; ++round) {
    diary.written.clear();
    stages.compute = [](size_t index, int value) -> int {
      if (index == 10 || index == 11) throw InputError("bad frame");
      if (index % 3 == 0) std::this_thread::sleep_for(milliseconds(1));
      return value;
    };
    const BatchResult result = run(200, 4);
    ASSERT_GE(result.failures.size(), 1u);
    EXPECT_EQ(result.failures[0].index, 10u);
    for (size_t i = 0; i < 10; ++i) EXPECT_TRUE(diary.written.contains(i)) << i;
    EXPECT_LT(diary.written.size(), 30u);
    EXPECT_EQ(result.done + result.failures.size() + result.untouched, 200u);
    EXPECT_FALSE(result.stopped);
  }
}

TEST_F(Batch, AFullDiskStopsEvenWhenSkippingBadFrames) {
  options.skipBadFrames = true;
  stages.write = [this](size_t index, int value) {
    if (index >= 5) throw OutputError("disk full");
    std::lock_guard lock(diary.mutex);
    diary.written[index] = value;
  };
  const BatchResult result = run(100, 2);
  EXPECT_EQ(result.failures.front().index, 5u);
  EXPECT_EQ(result.failures.front().message, "disk full");
  EXPECT_LE(result.failures.size(), 2u);
  EXPECT_EQ(diary.written.size(), 5u);
}

TEST_F(Batch, KeepsFramesThatAreDone) {
  stages.isDone = [](size_t index) { return index % 2 == 0; };
  const BatchResult result = run(10);
  EXPECT_EQ(result.kept, 5u);
  EXPECT_EQ(result.done, 5u);
  EXPECT_EQ(writtenFrames(), (std::set<size_t>{1, 3, 5, 7, 9}));
  for (const FrameEvent& event : diary.events)
    EXPECT_EQ(event.outcome, event.index % 2 == 0 ? FrameOutcome::kept : FrameOutcome::done);
}

TEST_F(Batch, AStopTokenGivesUpBetweenStages) {
  std::stop_source source;
  options.stop = source.get_token();
  std::atomic<int> computed{0};
  stages.compute = [&](size_t index, int value) {
    ++computed;
    if (index == 5) source.request_stop();
    return value;
  };
  const BatchResult result = run(1000, 2);
  EXPECT_TRUE(result.stopped);
  EXPECT_FALSE(diary.written.contains(5));
  EXPECT_LE(computed, 8);
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.done + result.untouched, 1000u);
}

TEST_F(Batch, AStopAfterTheLastFrameIsNoStop) {
  std::stop_source source;
  options.stop = source.get_token();
  options.onFrame = [&](const FrameEvent&) { source.request_stop(); };
  EXPECT_FALSE(run(1, 1).stopped);
}

TEST_F(Batch, ParallelLoopsInsideNeverRunAnotherFramesStage) {
  // A thread that waits in a frame's loop must not open a second frame on top of it.
  static thread_local int depth = 0;
  std::atomic<int> deepest{0};
  stages.compute = [&](size_t, int value) {
    ++depth;
    if (depth > deepest) deepest = depth;
    std::atomic<int> sum{0};
    parallelRows(64, 1, [&](int first, int) {
      std::this_thread::sleep_for(std::chrono::microseconds(50 + 10 * (first % 5)));
      sum += first;
    });
    --depth;
    return value + sum - 64 * 63 / 2;
  };
  const BatchResult result = run(40, 4);
  EXPECT_EQ(result.done, 40u);
  EXPECT_EQ(deepest, 1);
  EXPECT_LE(diary.mostOpen, 4);
}

TEST_F(Batch, FramesMayBeMovableOnly) {
  Stages<std::unique_ptr<int>, std::unique_ptr<int>> movable;
  std::atomic<int> sum{0};
  movable.read = [](size_t index) { return std::make_unique<int>(static_cast<int>(index)); };
  movable.compute = [](size_t, std::unique_ptr<int> value) { return value; };
  movable.write = [&](size_t, std::unique_ptr<int> value) { sum += *value; };
  EXPECT_EQ(runBatch(10, movable, {}).done, 10u);
  EXPECT_EQ(sum, 45);
}

}  // namespace
}  // namespace kagefude
